/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "formats/exchange/abaqus.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Parts and their instances. What a part or an instance holds is read into cells of its own; the end of an instance
 * puts them, moved and turned, into those of the assembly. Where there are several, names get the instance's name
 * before them, as Abaqus has it (ARM-1.TOP), and numbers begin anew after each `stride`. */

static const OstGlobal stride = 1000000000, own = 900000000000000; /* the assembly's own nodes begin after that */

static const OstInpInstance as_it_is;
static const double degree = 3.14159265358979323846 / 180.0;

/* What is no label is refused later. */
static OstGlobal moved(OstGlobal label, OstGlobal offset)
{
    return label >= 0 && label <= OST_LARGEST_LABEL ? label + offset : label;
}

/* Translation, then a turn about the line from a to b. */
static void place(const OstInpInstance *instance, const double *x, double placed[3])
{
    const double *a = instance->line[1], angle = instance->line[1][6] * degree;
    double axis[3], arm[3], across[3];
    for (int i = 0; i < 3; i++) {
        placed[i] = x[i] + instance->line[0][i];
        axis[i] = a[i + 3] - a[i];
        arm[i] = placed[i] - a[i];
    }
    const double length = ost_norm3(axis);
    if (length == 0.0 || angle == 0.0)
        return;
    for (int i = 0; i < 3; i++)
        axis[i] /= length;
    ost_cross3(axis, arm, across);
    const double along = ost_dot3(axis, arm) * (1.0 - cos(angle));
    for (int i = 0; i < 3; i++)
        placed[i] = a[i] + cos(angle) * arm[i] + sin(angle) * across[i] + along * axis[i];
}

/* INSTANCE.NAME, in quotes if one of them is. */
static void whole_name(const char *instance, const char *name, char whole[2 * OST_INP_WORD])
{
    const int quoted = instance[0] == '"' || name[0] == '"';
    snprintf(whole, 2 * OST_INP_WORD, "%s%s.%s", quoted ? "\"" : "", instance + (instance[0] == '"'),
             name + (name[0] == '"'));
}

static OstStatus add_nodes(const OstCells *from, const OstInpInstance *instance, OstGlobal offset, OstCells *to)
{
    for (OstLocal n = 0; n < from->chunk->node_count; n++) {
        double x[3];
        place(instance, from->chunk->coordinates + 3 * (size_t)n, x);
        OST_TRY(ost_cells_add_node(to, from->chunk->node_label[n] + offset, x));
    }
    return OST_SUCCESS;
}

static OstStatus add_cells(const OstCells *from, OstCellKind kind, OstGlobal offset, OstCells *to)
{
    const OstCellList *list = &from->list[kind];
    const OstLocal width = ost_cell_facts[kind].nodes;
    OstGlobal nodes[27];
    for (OstLocal c = 0; c < list->count; c++) {
        for (OstLocal k = 0; k < width; k++)
            nodes[k] = moved(list->nodes[(size_t)c * (size_t)width + (size_t)k], offset);
        OST_TRY(ost_cells_add(to, kind, list->label[c] + offset, OST_NO_GROUP, nodes));
    }
    return OST_SUCCESS;
}

static OstStatus add_set(const OstCellSet *from, const char *name, OstGlobal offset, OstCells *to)
{
    const OstGlobal shift = from->kind == OST_SET_OF_FACES ? ost_cell_face(offset, 0) : offset;
    int set = -1;
    OST_TRY(ost_cells_set(to, from->kind, name, &set));
    to->set[set].is_region = from->is_region;
    for (OstLocal i = 0; i < from->count; i++)
        OST_TRY(ost_cells_put(to, set, from->item[i] + shift));
    return OST_SUCCESS;
}

/* `prefix`: the instance's name before those of sets, or NULL. */
static OstStatus add_all(const OstCells *from, const OstInpInstance *instance, OstGlobal offset, const char *prefix,
                         OstCells *to)
{
    OST_TRY(add_nodes(from, instance, offset, to));
    for (int kind = 0; kind < OST_CELL_KINDS; kind++)
        OST_TRY(add_cells(from, (OstCellKind)kind, offset, to));
    for (int s = 0; s < from->set_count; s++) {
        char name[2 * OST_INP_WORD];
        snprintf(name, sizeof name, "%s", from->set[s].name);
        if (prefix)
            whole_name(prefix, from->set[s].name, name);
        OST_TRY(add_set(&from->set[s], name, offset, to));
    }
    for (OstGlobal i = 0; i < from->solids; i++)
        ost_cells_skip(to, 3, from->solid);
    for (OstGlobal i = 0; i < from->others; i++)
        ost_cells_skip(to, 2, from->other);
    return OST_SUCCESS;
}

/* What follows is read into cells of its own. */
static OstStatus go_inside(OstInp *inp, int inside)
{
    const OstCells outer = inp->cells;
    if (inp->inside)
        return OST_RAISE_LINE(inp->lines, "a part or an instance within another one");
    inp->cells = (OstCells){0};
    const OstStatus status = ost_cells_open(inp->ctx, outer.path, &inp->cells);
    inp->cells.same_names = outer.same_names;
    inp->outer = outer;
    inp->inside = inside;
    return status;
}

static OstCells go_outside(OstInp *inp)
{
    const OstCells inner = inp->cells;
    inp->cells = inp->outer;
    inp->outer = (OstCells){0};
    inp->inside = OST_INP_OUTSIDE;
    return inner;
}

OstStatus ost_inp_begin_part(OstInp *inp, const OstInpKeyword *keyword)
{
    char name[OST_INP_WORD] = "";
    ost_inp_set_name(keyword, "NAME", name);
    OST_TRY(OST_RESIZE(inp->ctx, &inp->part, inp->part_count + 1));
    OstInpPart *part = &inp->part[inp->part_count++];
    *part = (OstInpPart){0};
    memcpy(part->name, name, sizeof name);
    return go_inside(inp, OST_INP_PART);
}

OstStatus ost_inp_end_part(OstInp *inp)
{
    if (inp->inside != OST_INP_PART)
        return OST_RAISE_LINE(inp->lines, "*END PART without *PART");
    inp->part[inp->part_count - 1].cells = go_outside(inp);
    return OST_SUCCESS;
}

static const OstInpPart *find_part(const OstInp *inp, const char *name)
{
    for (int p = 0; p < inp->part_count; p++)
        if (inp->cells.same_names(inp->part[p].name, name))
            return &inp->part[p];
    return NULL;
}

/* An instance begins with all that its part has, and may add to it, as independent ones do. */
OstStatus ost_inp_begin_instance(OstInp *inp, const OstInpKeyword *keyword)
{
    char name[OST_INP_WORD] = "", part_name[OST_INP_WORD];
    ost_inp_set_name(keyword, "NAME", name);
    const OstInpPart *part = ost_inp_set_name(keyword, "PART", part_name) ? find_part(inp, part_name) : inp->part;
    if (!part && inp->part_count > 0)
        return OST_RAISE_LINE(inp->lines, "an instance of the part '%s', which is not before this line", part_name);
    OST_TRY(OST_RESIZE(inp->ctx, &inp->instance, inp->instance_count + 1));
    OstInpInstance *instance = &inp->instance[inp->instance_count++];
    *instance = as_it_is;
    memcpy(instance->name, name, sizeof name);
    OST_TRY(go_inside(inp, OST_INP_INSTANCE_OF));
    inp->block = OST_INP_INSTANCE;
    return part ? add_all(&part->cells, &as_it_is, 0, NULL, &inp->cells) : OST_SUCCESS;
}

/* First the translation, then two points of a line and the degrees about it. */
OstStatus ost_inp_instance_line(OstInp *inp)
{
    OstInpInstance *instance = &inp->instance[inp->instance_count - 1];
    if (instance->lines == 2)
        return OST_RAISE_LINE(inp->lines, "a third line of an instance; a translation and a rotation are expected");
    const int count = instance->lines == 0 ? 3 : 7;
    for (int i = 0; i < count; i++)
        OST_TRY(ost_lines_number(inp->lines, "a number of the instance's translation or rotation",
                                 &instance->line[instance->lines][i]));
    instance->lines++;
    return OST_SUCCESS;
}

/* Once there is a second instance, sets of the first get its name as well. */
static OstStatus name_first(OstInp *inp)
{
    for (int s = 0; s < inp->first_sets; s++) {
        char name[2 * OST_INP_WORD];
        char *copy = NULL;
        whole_name(inp->instance[0].name, inp->cells.set[s].name, name);
        OST_TRY(ost_copy_string(inp->ctx, name, &copy));
        OST_FREE(inp->cells.set[s].name);
        inp->cells.set[s].name = copy;
    }
    return OST_SUCCESS;
}

static OstStatus take_instance(OstInp *inp, const OstCells *cells)
{
    const int number = inp->instance_count - 1;
    const OstInpInstance *instance = &inp->instance[number];
    if (number == 1)
        OST_TRY(name_first(inp));
    OST_TRY(add_all(cells, instance, number * stride, number > 0 ? instance->name : NULL, &inp->cells));
    if (number == 0)
        inp->first_sets = inp->cells.set_count;
    return OST_SUCCESS;
}

OstStatus ost_inp_end_instance(OstInp *inp)
{
    if (inp->inside != OST_INP_INSTANCE_OF)
        return OST_RAISE_LINE(inp->lines, "*END INSTANCE without *INSTANCE");
    OstCells cells = go_outside(inp);
    const OstStatus status = take_instance(inp, &cells);
    ost_cells_close(&cells);
    return status;
}

OstStatus ost_inp_end_parts(OstInp *inp)
{
    if (inp->inside)
        return OST_RAISE(inp->ctx, OST_INVALID_INPUT, "%s: the file ends within a part or an instance",
                         inp->cells.path);
    if (inp->part_count == 0 || inp->instance_count > 0)
        return OST_SUCCESS;
    if (inp->part_count > 1)
        return OST_RAISE(inp->ctx, OST_INVALID_INPUT,
                         "%s: %d parts and no instance of them; *INSTANCE says where they are", inp->cells.path,
                         inp->part_count);
    return add_all(&inp->part[0].cells, &as_it_is, 0, NULL, &inp->cells);
}

void ost_inp_close_parts(OstInp *inp)
{
    for (int p = 0; p < inp->part_count; p++)
        if (inp->part[p].cells.ctx)
            ost_cells_close(&inp->part[p].cells);
    if (inp->inside)
        ost_cells_close(&inp->outer);
    OST_FREE(inp->part, inp->instance);
}

/* --- what is in an instance, by name --- */

static int find_instance(const OstInp *inp, const char *name, size_t length)
{
    char word[OST_INP_WORD];
    snprintf(word, sizeof word, "%.*s", (int)length, name);
    for (int i = 0; i < inp->instance_count; i++)
        if (inp->cells.same_names(inp->instance[i].name, word))
            return i;
    return -1;
}

OstStatus ost_inp_set_instance(OstInp *inp, const OstInpKeyword *keyword)
{
    char name[OST_INP_WORD];
    inp->of = ost_inp_set_name(keyword, "INSTANCE", name) ? find_instance(inp, name, strlen(name)) : -1;
    return inp->of >= 0 || !ost_inp_value(keyword, "INSTANCE") || inp->instance_count < 2
               ? OST_SUCCESS
               : OST_RAISE_LINE(inp->lines, "there is no instance '%s' before this line", name);
}

OstGlobal ost_inp_number(const OstInp *inp, OstSetKind kind, const char *word, OstGlobal label)
{
    const char *dot = strrchr(word, '.');
    const int of = dot ? find_instance(inp, word, (size_t)(dot - word)) : inp->of;
    if (of < 0 && !dot && kind == OST_SET_OF_NODES && inp->own_nodes && !inp->inside)
        return moved(label, own);
    return moved(label, of > 0 ? of * stride : 0);
}

int ost_inp_find_set(const OstInp *inp, OstSetKind kind, const char *word)
{
    char name[2 * OST_INP_WORD];
    const char *dot = strrchr(word, '.');
    if (inp->instance_count > 1 && inp->of >= 0) {
        whole_name(inp->instance[inp->of].name, word, name);
        const int found = ost_cells_find_set(&inp->cells, kind, name);
        if (found >= 0)
            return found;
    }
    const int found = ost_cells_find_set(&inp->cells, kind, word);
    if (found >= 0 || !dot || inp->instance_count > 1)
        return found;
    snprintf(name, sizeof name, "%s%s", word[0] == '"' ? "\"" : "", dot + 1);
    return ost_cells_find_set(&inp->cells, kind, name);
}
