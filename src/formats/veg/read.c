/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/veg/veg.h"

#include <string.h>

static const struct {
    const char *keyword;
    OstStatus (*read)(OstVeg *veg);
    int ends_with_keyword; /* it has read up to the next keyword */
} section[] = {{"*VERTICES", ost_veg_vertices, 0},
               {"*ELEMENTS", ost_veg_elements, 0},
               {"*MATERIAL", ost_veg_material, 0},
               {"*SET", ost_veg_set, 1},
               {"*REGION", ost_veg_region, 0}};

enum { SECTIONS = sizeof section / sizeof *section };

/* Number of the section whose keyword begins the line. */
static OstStatus find_section(OstVeg *veg, int *number)
{
    OstLineReader *reader = ost_veg_reader(veg);
    const size_t length = strcspn(reader->text, " \t");
    for (*number = 0; *number < SECTIONS; (*number)++)
        if (strlen(section[*number].keyword) == length &&
            strncmp(reader->text, section[*number].keyword, length) == 0) {
            reader->next = reader->text + length;
            return OST_SUCCESS;
        }
    if (reader->text[0] != '*')
        return OST_RAISE_LINE(reader,
                              "'%.60s' found outside of a section, expected a keyword (does the section above "
                              "hold more lines than it states?)",
                              reader->text);
    return OST_RAISE_LINE(reader,
                          "keyword '%.60s' is unknown, expected *VERTICES, *ELEMENTS, *MATERIAL, *SET, *REGION "
                          "or *INCLUDE",
                          reader->text);
}

static OstStatus read_sections(OstVeg *veg)
{
    int found = 0, number = 0;
    OST_TRY(ost_veg_next(veg, &found));
    while (found) {
        OST_TRY(find_section(veg, &number));
        OST_TRY(section[number].read(veg));
        if (!section[number].ends_with_keyword)
            OST_TRY(ost_veg_next(veg, &found));
        else
            found = ost_veg_reader(veg)->text[0] == '*';
    }
    if (veg->element_count == 0)
        return OST_RAISE_LINE(ost_veg_reader(veg), "the file ends without %s",
                              veg->vertex_count == 0 ? "*VERTICES" : "*ELEMENTS");
    return OST_SUCCESS;
}

void ost_veg_close(OstVeg *veg)
{
    for (int i = 0; i < veg->depth; i++)
        ost_lines_close(&veg->reader[i]);
    for (int s = 0; veg->set && s < veg->set_names.count; s++)
        OST_FREE(veg->set[s].name);
    OST_FREE(veg->set, veg->set_elements);
    ost_veg_names_clear(&veg->set_names);
    ost_veg_names_clear(&veg->material_names);
    OST_FREE(veg->material, veg->axes, veg->coordinates, veg->vertex_id, veg->element_vertices, veg->element_id);
    ost_label_index_clear(&veg->vertices);
    ost_label_index_clear(&veg->elements);
}

OstStatus ost_veg_read(OstContext *ctx, const char *path, OstMeshChunk **chunk, OstFileMaterials **materials)
{
    OstVeg veg = {0};
    OstStatus status = OST_SUCCESS;
    *chunk = NULL;
    *materials = NULL;
    OST_TRY_DONE(ost_veg_open(ctx, path, &veg));
    OST_TRY_DONE(read_sections(&veg));
    OST_TRY_DONE(ost_veg_chunk(&veg, chunk, materials));
done:
    ost_veg_close(&veg);
    if (status != OST_SUCCESS) {
        ost_chunk_destroy(chunk);
        ost_file_materials_destroy(materials);
    }
    return status;
}
