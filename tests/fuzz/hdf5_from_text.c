/* SPDX-License-Identifier: BSD-3-Clause */
#include "hdf5_from_text.h"

#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MOST_TEXT = 1 << 16, MOST_VALUES = 1 << 14, MOST_DIMENSIONS = 4, LONGEST_STRING = 64, FILE_STEP = 1 << 16 };

static const double MOST_CLAIMED = 1e17; /* times the longest string is no more than 64 bits hold */

/* What one line asks for. */
typedef struct Array {
    const char *name, *layout;
    char *values;
    H5T_class_t class;
    hid_t type;   /* in the file */
    hid_t memory; /* of the values handed over: a double, an integer, or the string itself */
    int dimensions;
    hsize_t extent[MOST_DIMENSIONS];
    double count;
} Array;

static union {
    double real[MOST_VALUES];
    int64_t integer[MOST_VALUES];
    char string[MOST_VALUES * sizeof(double)];
    const char *pointer[MOST_VALUES];
} buffer;

/* --- types and shapes --- */

static int make_string_type(const char *digits, H5T_cset_t letters, Array *array)
{
    const long size = strtol(digits, NULL, 10);
    if (*digits != '\0' && (size < 1 || size > LONGEST_STRING))
        return 0;
    array->class = H5T_STRING;
    array->type = H5Tcopy(H5T_C_S1);
    H5Tset_size(array->type, *digits == '\0' ? H5T_VARIABLE : (size_t)size);
    H5Tset_cset(array->type, letters);
    array->memory = H5Tcopy(array->type);
    return 1;
}

static int make_type(const char *word, Array *array)
{
    const struct {
        const char *word;
        hid_t type;
    } numbers[] = {{"i8", H5T_STD_I8LE},   {"u8", H5T_STD_U8LE},   {"i16", H5T_STD_I16LE},  {"i32", H5T_STD_I32LE},
                   {"i64", H5T_STD_I64LE}, {"u64", H5T_STD_U64LE}, {"f32", H5T_IEEE_F32LE}, {"f64", H5T_IEEE_F64LE},
                   {"b32", H5T_STD_I32BE}, {"b64", H5T_STD_I64BE}};
    if (strncmp(word, "text", 4) == 0)
        return make_string_type(word + 4, H5T_CSET_UTF8, array);
    if (strncmp(word, "ascii", 5) == 0)
        return make_string_type(word + 5, H5T_CSET_ASCII, array);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        if (strcmp(word, numbers[i].word) != 0)
            continue;
        array->type = H5Tcopy(numbers[i].type);
        array->class = H5Tget_class(array->type);
        array->memory = H5Tcopy(array->class == H5T_FLOAT ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64);
        return 1;
    }
    return 0;
}

static int read_shape(const char *word, Array *array)
{
    array->count = 1;
    if (strcmp(word, "-") == 0)
        return 1;
    for (const char *at = word; array->dimensions < MOST_DIMENSIONS; at++) {
        char *end = NULL;
        const unsigned long long extent = strtoull(at, &end, 10);
        if (end == at || extent > INT64_MAX)
            return 0;
        array->extent[array->dimensions++] = extent;
        array->count *= (double)extent;
        at = end;
        if (*at != 'x')
            return *at == '\0';
    }
    return 0;
}

static hid_t make_space(const Array *array)
{
    return array->dimensions == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(array->dimensions, array->extent, NULL);
}

/* --- values --- */

static void store(const Array *array, size_t at, const char *word)
{
    const size_t size = H5Tget_size(array->type);
    if (array->class == H5T_FLOAT)
        buffer.real[at] = strtod(word, NULL);
    else if (array->class == H5T_INTEGER)
        buffer.integer[at] = strtoll(word, NULL, 10);
    else if (H5Tis_variable_str(array->type) > 0)
        buffer.pointer[at] = word;
    else if ((at + 1) * size <= sizeof buffer.string)
        memcpy(buffer.string + at * size, word, strnlen(word, size));
}

/* Is there anything to write? */
static int fill_buffer(const Array *array)
{
    static const char *words[MOST_VALUES];
    size_t found = 0;
    char *rest = NULL;
    if (!array->values || array->count * (double)H5Tget_size(array->memory) > (double)sizeof buffer.string)
        return 0;
    for (char *word = strtok_r(array->values, " \t", &rest); word && found < MOST_VALUES;
         word = strtok_r(NULL, " \t", &rest))
        words[found++] = word;
    if (found == 0)
        return 0;
    memset(&buffer, 0, sizeof buffer.real);
    for (size_t i = 0; i < (size_t)array->count; i++)
        store(array, i, words[i % found]);
    return 1;
}

/* --- objects --- */

static void write_attribute(hid_t file, const Array *array, const char *name)
{
    const hid_t space = make_space(array);
    const hid_t attribute =
        H5Acreate_by_name(file, array->name, name, array->type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (attribute >= 0 && fill_buffer(array))
        H5Awrite(attribute, array->memory, &buffer);
    if (attribute >= 0)
        H5Aclose(attribute);
    if (space >= 0)
        H5Sclose(space);
}

static hid_t make_layout(const Array *array)
{
    const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    const int packed = strcmp(array->layout, "packed") == 0;
    if (strcmp(array->layout, "compact") == 0)
        H5Pset_layout(layout, H5D_COMPACT);
    if (packed || strcmp(array->layout, "chunked") == 0) {
        hsize_t chunk[MOST_DIMENSIONS];
        for (int i = 0; i < array->dimensions; i++)
            chunk[i] = array->extent[i] < 3 ? 2 : array->extent[i] < 64 ? array->extent[i] - 1 : 64;
        H5Pset_chunk(layout, array->dimensions, chunk);
    }
    if (packed)
        H5Pset_deflate(layout, 6);
    return layout;
}

static void write_dataset(hid_t file, hid_t links, const Array *array)
{
    const hid_t space = make_space(array);
    const hid_t layout = make_layout(array);
    const hid_t dataset = H5Dcreate2(file, array->name, array->type, space, links, layout, H5P_DEFAULT);
    if (dataset >= 0 && fill_buffer(array))
        H5Dwrite(dataset, array->memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, &buffer);
    if (dataset >= 0)
        H5Dclose(dataset);
    if (space >= 0)
        H5Sclose(space);
    H5Pclose(layout);
}

static void write_group(hid_t file, hid_t links, const char *name)
{
    const hid_t group = H5Gcreate2(file, name, links, H5P_DEFAULT, H5P_DEFAULT);
    if (group >= 0)
        H5Gclose(group);
}

static void write_line(hid_t file, hid_t links, char *line)
{
    char *values = strchr(line, ':');
    if (values)
        *values++ = '\0';
    char *rest = NULL;
    char *name = strtok_r(line, " \t", &rest);
    char *type = strtok_r(NULL, " \t", &rest);
    char *shape = strtok_r(NULL, " \t", &rest);
    const char *layout = strtok_r(NULL, " \t", &rest);
    Array array = {.name = name, .layout = layout ? layout : "contiguous", .values = values};
    if (!name || *name != '/' || !name[1])
        return;
    if (!type) {
        write_group(file, links, name);
        return;
    }
    if (!shape || !read_shape(shape, &array) || !make_type(type, &array))
        return;
    char *attribute = strchr(name, '@');
    if (attribute) {
        *attribute++ = '\0';
        if (array.count <= MOST_VALUES) /* HDF5 multiplies without a look and writes where it must not */
            write_attribute(file, &array, attribute);
    } else if (array.count < MOST_CLAIMED) {
        write_dataset(file, links, &array);
    }
    H5Tclose(array.type);
    H5Tclose(array.memory);
}

size_t write_hdf5_from_text(const uint8_t *text, size_t size, const char *path)
{
    static char copy[MOST_TEXT + 1];
    struct stat facts;
    char *rest = NULL;
    const size_t length = size < MOST_TEXT ? size : MOST_TEXT;
    memcpy(copy, text, length);
    copy[length] = '\0';
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    H5set_free_list_limits(-1, -1, 0, 0, -1,
                           -1); /* HDF5's largest blocks, had anew for each file, took most of the time */
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    const hid_t links = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(links, 1);
    H5Pset_fapl_core(access, FILE_STEP, 1);
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, access);
    for (char *line = strtok_r(copy, "\n", &rest); line && file >= 0; line = strtok_r(NULL, "\n", &rest))
        write_line(file, links, line);
    H5Pclose(links);
    H5Pclose(access);
    if (file < 0 || H5Fclose(file) < 0 || stat(path, &facts) != 0) {
        perror(path);
        exit(1);
    }
    return (size_t)facts.st_size;
}
