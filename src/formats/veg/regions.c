/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/veg/veg.h"
#include "mesh/mesh_data.h"

#include <inttypes.h>
#include <limits.h>
#include <string.h>

/* *SET and *REGION, and the regions they make. */

static OstStatus add_set(OstVeg *veg, const char *name)
{
    const int number = veg->set_names.count;
    OST_TRY(OST_RESIZE(veg->ctx, &veg->set, number + 1));
    OST_TRY(ost_veg_names_add(veg, &veg->set_names, "*SET", name));
    veg->set[number] = (OstVegSet){.first = veg->set_used, .region = -1};
    return ost_copy_string(veg->ctx, name, &veg->set[number].name);
}

/* Set 0 has all elements. */
static OstStatus need_sets(OstVeg *veg, const char *keyword)
{
    if (veg->element_count == 0)
        return OST_RAISE_LINE(ost_veg_reader(veg), "%s before *ELEMENTS", keyword);
    return veg->set_names.count == 0 ? add_set(veg, "allElements") : OST_SUCCESS;
}

static OstStatus add_element(OstVeg *veg, OstVegSet *set, OstGlobal id)
{
    const OstGlobal element = ost_label_index_find(&veg->elements, id);
    if (element < 0)
        return OST_RAISE_LINE(ost_veg_reader(veg),
                              "set '%s' lists element %" PRId64 ", which is not among the %" PRId64 " of *ELEMENTS",
                              set->name, id, veg->element_count);
    if (veg->set_used == INT_MAX / 2)
        return OST_RAISE_LINE(ost_veg_reader(veg), "the sets list more than %d elements", INT_MAX / 2);
    OST_TRY(OST_GROW(veg->ctx, &veg->set_elements, veg->set_used + 1));
    veg->set_elements[veg->set_used++] = (OstLocal)element;
    set->count++;
    return OST_SUCCESS;
}

/* A set ends at the next keyword, which is left to be read again. */
OstStatus ost_veg_set(OstVeg *veg)
{
    char name[OST_VEG_NAME_SIZE];
    OST_TRY(ost_veg_name(veg, "*SET", name));
    OST_TRY(need_sets(veg, "*SET"));
    OST_TRY(add_set(veg, name));
    OstVegSet *set = &veg->set[veg->set_names.count - 1];
    int found = 0;
    OST_TRY(ost_veg_next(veg, &found));
    while (found && ost_veg_reader(veg)->text[0] != '*') {
        while (!ost_lines_ended(ost_veg_reader(veg))) {
            OstGlobal id = 0;
            OST_TRY(ost_lines_integer(ost_veg_reader(veg), "an element of the set", &id));
            OST_TRY(add_element(veg, set, id));
        }
        OST_TRY(ost_veg_next(veg, &found));
    }
    return OST_SUCCESS;
}

/* Splits "set, material" at the comma, or at a blank where there is none, and removes blanks. */
static OstStatus split_region(OstVeg *veg, char set[OST_VEG_NAME_SIZE], char material[OST_VEG_NAME_SIZE])
{
    OstLineReader *reader = ost_veg_reader(veg);
    char *separator = strchr(reader->text, ',');
    if (!separator)
        separator =
            reader->text + strspn(reader->text, " \t") + strcspn(reader->text + strspn(reader->text, " \t"), " \t");
    if (*separator == '\0')
        return OST_RAISE_LINE(reader, "'%.60s' found, expected the names of a set and of a material", reader->text);
    *separator = '\0';
    reader->next = reader->text;
    OST_TRY(ost_veg_name(veg, "the set of a *REGION", set));
    reader->next = separator + 1;
    return ost_veg_name(veg, "the material of a *REGION", material);
}

OstStatus ost_veg_region(OstVeg *veg)
{
    char set_name[OST_VEG_NAME_SIZE], material_name[OST_VEG_NAME_SIZE];
    OST_TRY(need_sets(veg, "*REGION"));
    OST_TRY(ost_veg_expect(veg, "the names of a set and of a material are"));
    OST_TRY(split_region(veg, set_name, material_name));
    const int set = ost_veg_names_find(&veg->set_names, set_name);
    const int material = ost_veg_names_find(&veg->material_names, material_name);
    if (set < 0)
        return OST_RAISE_LINE(ost_veg_reader(veg), "*REGION uses set '%s', which no *SET above defines", set_name);
    if (material < 0)
        return OST_RAISE_LINE(ost_veg_reader(veg), "*REGION uses material '%s', which no *MATERIAL above defines",
                              material_name);
    veg->set[set].region = veg->region_count++;
    veg->set[set].material = material;
    return OST_SUCCESS;
}

/* The set that determines each element's material: the one of the last *REGION it is in; -1 if it is in none. */
static void choose_sets(const OstVeg *veg, int32_t *chosen)
{
    const int whole = veg->set_names.count > 0 && veg->set[0].region >= 0 ? 0 : -1;
    for (OstGlobal e = 0; e < veg->element_count; e++)
        chosen[e] = whole;
    for (int s = 1; s < veg->set_names.count; s++)
        for (OstLocal i = veg->set[s].first; i < veg->set[s].first + veg->set[s].count; i++) {
            int32_t *now = &chosen[veg->set_elements[i]];
            if (veg->set[s].region > (*now < 0 ? -1 : veg->set[*now].region))
                *now = s;
        }
}

/* The material and axes of the region whose name has just been added. */
static OstStatus add_region(OstVeg *veg, int material, OstFileMaterials *materials)
{
    const int number = materials->count;
    OST_TRY(OST_RESIZE(veg->ctx, &materials->material, number + 1));
    OST_TRY(OST_RESIZE(veg->ctx, &materials->axes, 9 * ((size_t)number + 1)));
    materials->material[number] = veg->material[material];
    memcpy(materials->axes + 9 * (size_t)number, veg->axes + 9 * (size_t)material, 9 * sizeof(double));
    materials->count++;
    return OST_SUCCESS;
}

/* A region for every set that determined some element's material, in the order of the file; then one for elements in no
 * such set, which have the last material. region[s + 1] is the region of set s, region[0] that of the rest. */
static OstStatus make_regions(OstVeg *veg, const int32_t *chosen, int32_t *region, OstMeshChunk *chunk,
                              OstFileMaterials *materials)
{
    const int sets = veg->set_names.count;
    for (OstGlobal e = 0; e < veg->element_count; e++)
        region[chosen[e] + 1] = 1;
    for (int s = 0; s < sets; s++)
        if (region[s + 1]) {
            region[s + 1] = materials->count;
            OST_TRY(ost_names_add(veg->ctx, &chunk->regions, veg->set[s].name));
            OST_TRY(add_region(veg, veg->set[s].material, materials));
        }
    if (region[0]) {
        region[0] = materials->count;
        OST_TRY(ost_names_add_unique(veg->ctx, &chunk->regions, veg->region_count == 0 ? "allElements" : "rest"));
        OST_TRY(add_region(veg, veg->material_names.count - 1, materials));
    }
    return OST_SUCCESS;
}

static OstStatus fill_regions(OstVeg *veg, OstMeshChunk *chunk, OstFileMaterials *materials)
{
    int32_t *region = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(veg->ctx, &region, veg->set_names.count + 1));
    OST_TRY_DONE(OST_NEW(veg->ctx, &chunk->tet_region, veg->element_count));
    choose_sets(veg, chunk->tet_region);
    OST_TRY_DONE(make_regions(veg, chunk->tet_region, region, chunk, materials));
    for (OstGlobal e = 0; e < veg->element_count; e++)
        chunk->tet_region[e] = region[chunk->tet_region[e] + 1];
done:
    OST_FREE(region);
    return status;
}

static void move_mesh(OstVeg *veg, OstMeshChunk *chunk)
{
    chunk->ctx = veg->ctx;
    chunk->nodes_per_tet = 4;
    chunk->global_nodes = veg->vertex_count;
    chunk->global_tets = veg->element_count;
    chunk->node_count = (OstLocal)veg->vertex_count;
    chunk->tet_count = (OstLocal)veg->element_count;
    chunk->coordinates = veg->coordinates;
    chunk->node_label = veg->vertex_id;
    chunk->tet_nodes = veg->element_vertices;
    chunk->tet_label = veg->element_id;
    veg->coordinates = NULL;
    veg->vertex_id = veg->element_vertices = veg->element_id = NULL;
}

OstStatus ost_veg_chunk(OstVeg *veg, OstMeshChunk **chunk, OstFileMaterials **materials)
{
    if (veg->material_names.count == 0)
        OST_TRY(ost_veg_default_material(veg));
    OST_TRY(OST_NEW(veg->ctx, chunk, 1));
    OST_TRY(OST_NEW(veg->ctx, materials, 1));
    OST_TRY(fill_regions(veg, *chunk, *materials));
    move_mesh(veg, *chunk);
    return OST_NEW(veg->ctx, &(*chunk)->boundaries, 0);
}
