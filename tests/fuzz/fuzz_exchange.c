/* SPDX-License-Identifier: BSD-3-Clause */
#include "fuzz.h"
#include "read_mesh.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* The formats of other programs in one: the first letter of the input says which. TetGen's two files are divided by a
 * zero byte. */
static const struct {
    char letter;
    const char *ending;
} formats[] = {{'i', "inp"}, {'m', "mesh"}, {'b', "meshb"}, {'k', "vtk"}, {'u', "vtu"},
               {'d', "bdf"}, {'v', "unv"},  {'t', "ele"},   {'e', "node"}};

static char file_path[4096];

static size_t write_bytes(const char *path, const uint8_t *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    if (!file)
        return 0;
    const size_t written = fwrite(data, 1, size, file);
    fclose(file);
    return written;
}

static size_t write_as_named(const uint8_t *data, size_t size, const char *path)
{
    const char *dot = strrchr(path, '.');
    const int stem = (int)(dot - path);
    char other[4096];
    file_path[0] = '\0';
    for (size_t f = 0; f < sizeof formats / sizeof *formats && size > 0; f++)
        if (data[0] == (uint8_t)formats[f].letter)
            snprintf(file_path, sizeof file_path, "%.*s.%s", stem, path, formats[f].ending);
    if (!file_path[0])
        return 0;
    const uint8_t *zero = data[0] == 't' || data[0] == 'e' ? memchr(data, 0, size) : NULL;
    const size_t first = zero ? (size_t)(zero - data) - 1 : size - 1;
    snprintf(other, sizeof other, "%.*s.%s", stem, path, data[0] == 't' ? "node" : "ele");
    if (zero)
        write_bytes(other, zero + 1, size - first - 2);
    else
        unlink(other);
    return write_bytes(file_path, data + 1, first) + (zero ? size - first - 2 : 0);
}

static void read_as_named(OstContext *ctx, const char *path)
{
    OstMeshChunk *chunk = NULL;
    OstFileMaterials *materials = NULL;
    (void)path;
    if (!file_path[0])
        return;
    if (ost_mesh_file_read(ctx, file_path, &chunk, &materials) == OST_SUCCESS)
        (void)ost_mesh_file_read_field(ctx, file_path, "modulus", OST_FIELD_OF_NUMBERS, chunk);
    ost_chunk_destroy(&chunk);
    ost_file_materials_destroy(&materials);
    read_mesh(ctx, file_path);
}

/* Packed data may unpack to fifty times their size. */
const FuzzTarget fuzz_target = {
    .file = "mesh.any", .read = read_as_named, .write = write_as_named, .constant = 16 << 20};
