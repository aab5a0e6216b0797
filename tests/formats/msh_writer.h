/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_FORMATS_MSH_WRITER_H
#define ORTHOSTAT_TESTS_FORMATS_MSH_WRITER_H

#include "scratch.h"

/* Writes small .msh files in every flavour, after the description of the formats 1 to 4.1 in Gmsh's manuals. */

typedef struct MshNode {
    int tag;
    double x[3];
} MshNode;

typedef struct MshElement {
    int tag, type, dimension, physical, entity; /* 4.1: elements of an entity have the same physical tag */
    int nodes[10];
} MshElement;

typedef struct MshModel {
    const char *names; /* lines of $PhysicalNames; NULL for none */
    int node_count, element_count;
    const MshNode *node;
    const MshElement *element;
} MshModel;

typedef struct MshFlavour {
    const char *name;
    int version, binary, swapped;
} MshFlavour;

static const MshFlavour msh_flavours[] = {{"1 text", 10, 0, 0},     {"2.0 text", 20, 0, 0},    {"2.0 binary", 20, 1, 0},
                                          {"2.1 text", 21, 0, 0},   {"2.1 swapped", 21, 1, 1}, {"2.2 text", 22, 0, 0},
                                          {"2.2 binary", 22, 1, 0}, {"2.2 swapped", 22, 1, 1}, {"4.0 text", 40, 0, 0},
                                          {"4.0 binary", 40, 1, 0}, {"4.1 text", 41, 0, 0},    {"4.1 binary", 41, 1, 0},
                                          {"4.1 swapped", 41, 1, 1}};
enum { MSH_FLAVOURS = 13, MSH_22_TEXT = 5, MSH_22_BINARY = 6, MSH_41_TEXT = 10, MSH_41_BINARY = 11, MSH_SIZE = 16384 };

typedef struct MshFile {
    MshFlavour flavour;
    size_t length;
    char bytes[MSH_SIZE];
} MshFile;

static void put_text(MshFile *file, const char *text)
{
    assert_true(file->length + strlen(text) < MSH_SIZE);
    strcpy(file->bytes + file->length, text);
    file->length += strlen(text);
}

static void put_raw(MshFile *file, const void *value, size_t size)
{
    assert_true(file->length + size < MSH_SIZE);
    for (size_t i = 0; i < size; i++)
        file->bytes[file->length++] = ((const char *)value)[file->flavour.swapped ? size - 1 - i : i];
}

static void put_int(MshFile *file, int value)
{
    char text[32];
    snprintf(text, sizeof text, "%d ", value);
    if (file->flavour.binary)
        put_raw(file, &value, sizeof value);
    else
        put_text(file, text);
}

static void put_size(MshFile *file, size_t value)
{
    if (file->flavour.binary)
        put_raw(file, &value, sizeof value);
    else
        put_int(file, (int)value);
}

static void put_double(MshFile *file, double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.17g ", value);
    if (file->flavour.binary)
        put_raw(file, &value, sizeof value);
    else
        put_text(file, text);
}

static void put_line_end(MshFile *file)
{
    if (!file->flavour.binary)
        put_text(file, "\n");
}

static int element_nodes(int type)
{
    static const int nodes[16] = {0, 2, 3, 4, 4, 8, 6, 5, 3, 6, 9, 10, 27, 18, 14, 1};
    return nodes[type];
}

static void put_count_line(MshFile *file, int count)
{
    char text[32];
    snprintf(text, sizeof text, "%d\n", count);
    put_text(file, text);
}

static void put_model_2(MshFile *file, const MshModel *model)
{
    const int first = file->flavour.version < 20;
    put_text(file, first ? "$NOD\n" : "$Nodes\n");
    put_count_line(file, model->node_count);
    for (const MshNode *n = model->node; n < model->node + model->node_count; n++) {
        put_int(file, n->tag);
        for (int c = 0; c < 3; c++)
            put_double(file, n->x[c]);
        put_line_end(file);
    }
    put_text(file, file->flavour.binary ? "\n$EndNodes\n$Elements\n"
                   : first              ? "$ENDNOD\n$ELM\n"
                                        : "$EndNodes\n$Elements\n");
    put_count_line(file, model->element_count);
    for (const MshElement *e = model->element; e < model->element + model->element_count; e++) {
        const int head[2][3] = {{e->tag, e->type, 2}, {e->type, 1, 2}};
        for (int i = 0; i < 3 - first; i++)
            put_int(file, head[file->flavour.binary][i]);
        if (file->flavour.binary)
            put_int(file, e->tag);
        put_int(file, e->physical);
        put_int(file, e->entity);
        if (first)
            put_int(file, element_nodes(e->type));
        for (int i = 0; i < element_nodes(e->type); i++)
            put_int(file, e->nodes[i]);
        put_line_end(file);
    }
    put_text(file, file->flavour.binary ? "\n$EndElements\n" : first ? "$ENDELM\n" : "$EndElements\n");
}

/* Is the element the first of its entity? */
static int begins_entity(const MshModel *model, const MshElement *element)
{
    for (const MshElement *e = model->element; e < element; e++)
        if (e->dimension == element->dimension && e->entity == element->entity)
            return 0;
    return 1;
}

static void put_entities(MshFile *file, const MshModel *model)
{
    for (int dimension = 0; dimension < 4; dimension++) {
        size_t count = 0;
        for (int i = 0; i < model->element_count; i++)
            count += model->element[i].dimension == dimension && begins_entity(model, &model->element[i]);
        put_size(file, count);
    }
    put_line_end(file);
    for (int dimension = 0; dimension < 4; dimension++)
        for (const MshElement *e = model->element; e < model->element + model->element_count; e++) {
            if (e->dimension != dimension || !begins_entity(model, e))
                continue;
            put_int(file, e->entity);
            for (int i = 0; i < (dimension == 0 && file->flavour.version > 40 ? 3 : 6); i++)
                put_double(file, 0.0);
            put_size(file, e->physical != 0);
            if (e->physical != 0)
                put_int(file, e->physical);
            if (dimension > 0)
                put_size(file, 0);
            put_line_end(file);
        }
}

/* A tag of a node or an element: version 4.0 has int. */
static void put_tag(MshFile *file, int tag)
{
    if (file->flavour.version > 40)
        put_size(file, (size_t)tag);
    else
        put_int(file, tag);
}

static void put_head(MshFile *file, int blocks, int count)
{
    const size_t head[4] = {(size_t)blocks, (size_t)count, 1, 100};
    for (int i = 0; i < (file->flavour.version > 40 ? 4 : 2); i++)
        put_size(file, head[i]);
    put_line_end(file);
}

static void put_block(MshFile *file, int dimension, int entity, int number, int count)
{
    const int old = file->flavour.version == 40;
    put_int(file, old ? entity : dimension);
    put_int(file, old ? dimension : entity);
    put_int(file, number);
    put_size(file, (size_t)count);
    put_line_end(file);
}

static void put_model_4(MshFile *file, const MshModel *model)
{
    put_text(file, "$Entities\n");
    put_entities(file, model);
    put_text(file, file->flavour.binary ? "\n$EndEntities\n$Nodes\n" : "$EndEntities\n$Nodes\n");
    put_head(file, 1, model->node_count);
    put_block(file, 3, model->element[model->element_count - 1].entity, 0, model->node_count);
    for (int n = 0; file->flavour.version > 40 && n < model->node_count; n++) {
        put_tag(file, model->node[n].tag);
        put_line_end(file);
    }
    for (int n = 0; n < model->node_count; n++) {
        if (file->flavour.version == 40)
            put_tag(file, model->node[n].tag);
        for (int c = 0; c < 3; c++)
            put_double(file, model->node[n].x[c]);
        put_line_end(file);
    }
    put_text(file, file->flavour.binary ? "\n$EndNodes\n$Elements\n" : "$EndNodes\n$Elements\n");
    put_head(file, model->element_count, model->element_count);
    for (const MshElement *e = model->element; e < model->element + model->element_count; e++) {
        put_block(file, e->dimension, e->entity, e->type, 1);
        put_tag(file, e->tag);
        for (int i = 0; i < element_nodes(e->type); i++)
            put_tag(file, e->nodes[i]);
        put_line_end(file);
    }
    put_text(file, file->flavour.binary ? "\n$EndElements\n" : "$EndElements\n");
}

/* Version 2.0 does not write the dimension, which is the first of each line but that of the count. */
static void put_names(MshFile *file, const char *names)
{
    const char *line = strchr(names, '\n') + 1;
    put_text(file, "$PhysicalNames\n");
    put_count_line(file, atoi(names));
    for (; *line; line = strchr(line, '\n') + 1) {
        char text[128];
        const char *start = line + (file->flavour.version == 20 ? 2 : 0);
        snprintf(text, sizeof text, "%.*s\n", (int)strcspn(start, "\n"), start);
        put_text(file, text);
    }
    put_text(file, "$EndPhysicalNames\n");
}

static void put_format(MshFile *file)
{
    const int one = 1;
    char text[64];
    snprintf(text, sizeof text, "$MeshFormat\n%d.%d %d 8\n", file->flavour.version / 10, file->flavour.version % 10,
             file->flavour.binary);
    put_text(file, text);
    if (file->flavour.binary) {
        put_raw(file, &one, sizeof one);
        put_text(file, "\n");
    }
    put_text(file, "$EndMeshFormat\n");
}

static void msh_make(const MshModel *model, MshFlavour flavour, MshFile *file)
{
    *file = (MshFile){.flavour = flavour};
    if (flavour.version > 10)
        put_format(file);
    if (flavour.version > 10 && model->names)
        put_names(file, model->names);
    if (flavour.version < 40)
        put_model_2(file, model);
    else
        put_model_4(file, model);
}

/* Writes the model under this name in the scratch folder and gives the path. */
static inline const char *msh_write(const MshModel *model, MshFlavour flavour, const char *name)
{
    static MshFile file;
    msh_make(model, flavour, &file);
    return write_bytes(name, file.bytes, file.length);
}

#endif
