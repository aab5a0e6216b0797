/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtu/heading.h"

static const char *const centring_word[] = {[OST_ON_NODES] = "PointData", [OST_ON_TETS] = "CellData"};

static const char *type_word(OstValueType type)
{
    return type == OST_VALUES_DOUBLE ? "Float64" : type == OST_VALUES_INT32 ? "Int32" : "Int64";
}

void ost_xml_write(FILE *text, const char *words)
{
    for (; *words; words++)
        switch (*words) {
        case '&':
            fputs("&amp;", text);
            break;
        case '<':
            fputs("&lt;", text);
            break;
        case '"':
            fputs("&quot;", text);
            break;
        default:
            fputc((unsigned char)*words < ' ' ? ' ' : *words, text);
        }
}

/* Type, name and components of a field; `element` is DataArray or PDataArray. */
static void open_field(FILE *text, const char *element, const OstOutputArray *array)
{
    OstOutputField field;
    const int is_known = ost_output_field_named(array->name, &field);
    char component[OST_LONGEST_COMPONENT];
    fprintf(text, "<%s type=\"%s\" Name=\"", element, type_word(array->type));
    ost_xml_write(text, array->name);
    fprintf(text, "\" NumberOfComponents=\"%d\"", array->components);
    for (int k = 0; is_known && k < array->components; k++) {
        ost_output_component(&field, k, component);
        if (*component)
            fprintf(text, " ComponentName%d=\"%s\"", k, component);
    }
}

static void write_field(FILE *text, const OstOutputArray *array, OstGlobal offset)
{
    OstOutputField field;
    open_field(text, "DataArray", array);
    fprintf(text, " format=\"appended\" offset=\"%lld\"", (long long)offset);
    if (ost_output_field_named(array->name, &field))
        fprintf(text,
                ">\n<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">%s</InformationKey>\n</DataArray>\n",
                field.unit);
    else
        fputs("/>\n", text);
}

static void write_fields(FILE *text, OstCentring centring, int count, const OstOutputArray *arrays,
                         const OstGlobal *offset)
{
    fprintf(text, "<%s>\n", centring_word[centring]);
    for (int a = 0; a < count; a++)
        if (arrays[a].centring == centring)
            write_field(text, &arrays[a], offset[a]);
    fprintf(text, "</%s>\n", centring_word[centring]);
}

/* --- what a person reads --- */

/* Within a comment two hyphens may not follow each other. */
static void write_words(FILE *text, const char *words)
{
    for (; *words; words++) {
        fputc(*words, text);
        if (words[0] == '-' && words[1] == '-')
            fputc(' ', text);
    }
}

/* A line for each field, region and reason. A comment, and not VTK's arrays of texts, which other readers refuse. */
static void write_comment(FILE *text, const OstMesh *mesh, int count, const OstOutputArray *arrays,
                          const OstOutputMark *mark)
{
    OstOutputField field;
    fputs("<!--\n", text);
    for (int a = 0; a < count; a++)
        if (ost_output_field_named(arrays[a].name, &field))
            fprintf(text, "field %s: %s; unit: %s%s%s\n", field.word, field.description, field.unit,
                    *field.component_names ? "; components: " : "", field.component_names);
    for (int r = 0; r < mesh->regions.count; r++) {
        fprintf(text, "region %d: ", r);
        write_words(text, mesh->regions.name[r]);
        fputc('\n', text);
    }
    for (int i = 0; mark && i < mark->reason_count; i++) {
        fprintf(text, "%s: ", mark->status);
        write_words(text, mark->reasons[i]);
        fputc('\n', text);
    }
    fputs("-->\n", text);
}

static void write_flag(FILE *text, const char *name)
{
    fprintf(text, "<DataArray type=\"Int32\" Name=\"%s\" NumberOfTuples=\"1\" format=\"ascii\">1</DataArray>\n", name);
}

/* The mark of what is no answer, as field data. */
static void write_mark(FILE *text, const OstOutputMark *mark)
{
    fputs("<FieldData>\n", text);
    write_flag(text, "refused");
    if (mark->unfinished)
        write_flag(text, "unfinished");
    fputs("</FieldData>\n", text);
}

/* --- the files --- */

static void open_file(FILE *text, const char *type)
{
    fprintf(text,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"%s\" version=\"1.0\" byte_order=\"%s\" header_type=\"UInt64\">\n",
            type, __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? "LittleEndian" : "BigEndian");
}

static void write_shape(FILE *text, const OstGlobal *offset)
{
    static const char form[] = "<DataArray type=\"%s\" Name=\"%s\"%s format=\"appended\" offset=\"%lld\"/>\n";
    fputs("<Points>\n", text);
    fprintf(text, form, "Float64", "Points", " NumberOfComponents=\"3\"", (long long)offset[OST_VTU_POINTS]);
    fputs("</Points>\n<Cells>\n", text);
    fprintf(text, form, "Int64", "connectivity", "", (long long)offset[OST_VTU_CONNECTIVITY]);
    fprintf(text, form, "Int64", "offsets", "", (long long)offset[OST_VTU_OFFSETS]);
    fprintf(text, form, "UInt8", "types", "", (long long)offset[OST_VTU_TYPES]);
    fputs("</Cells>\n", text);
}

void ost_vtu_heading(FILE *text, const OstMesh *mesh, int count, const OstOutputArray *arrays,
                     const OstOutputMark *mark, const OstGlobal *offset)
{
    open_file(text, "UnstructuredGrid");
    write_comment(text, mesh, count, arrays, mark);
    fputs("<UnstructuredGrid>\n", text);
    if (mark)
        write_mark(text, mark);
    fprintf(text, "<Piece NumberOfPoints=\"%lld\" NumberOfCells=\"%lld\">\n", (long long)mesh->global_nodes,
            (long long)mesh->global_tets);
    write_fields(text, OST_ON_NODES, count, arrays, offset);
    write_fields(text, OST_ON_TETS, count, arrays, offset);
    write_shape(text, offset + count);
    fputs("</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_", text);
}

void ost_pvtu_text(FILE *text, const char *piece, int count, const OstOutputArray *arrays)
{
    open_file(text, "PUnstructuredGrid");
    fputs("<PUnstructuredGrid GhostLevel=\"0\">\n", text);
    for (int centring = 0; centring < 2; centring++) {
        fprintf(text, "<P%s>\n", centring_word[centring]);
        for (int a = 0; a < count; a++)
            if ((int)arrays[a].centring == centring) {
                open_field(text, "PDataArray", &arrays[a]);
                fputs("/>\n", text);
            }
        fprintf(text, "</P%s>\n", centring_word[centring]);
    }
    fputs("<PPoints>\n<PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n</PPoints>\n<Piece "
          "Source=\"",
          text);
    ost_xml_write(text, piece);
    fputs("\"/>\n</PUnstructuredGrid>\n</VTKFile>\n", text);
}
