/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "formats/vtk/grid.h"

#include <math.h>
#include <string.h>

/* VTK's files have no place for sets. meshio writes its sets as one array of whole numbers: the number of the set that
 * a cell (or point) is in, -1 for none. The array's name is those of all sets with a sign between them, the first of
 * these that is in none of the names. */
static const char signs[] = "-_#+/";

enum { LONGEST_HEAD = 512 }; /* within which a file says who wrote it */

int ost_vtk_is_by_meshio(const OstMshCursor *cursor)
{
    static const char words[] = "by meshio v";
    const size_t length = (size_t)(cursor->end - cursor->next);
    return memmem(cursor->next, length < LONGEST_HEAD ? length : LONGEST_HEAD, words, sizeof words - 1) != NULL;
}

/* How many sets the array numbers; 0 where it numbers something else. */
static int count_numbers(const OstVtkArray *array)
{
    double largest = -1.0;
    for (OstGlobal i = 0; i < array->tuples; i++) {
        const double value = array->values[i];
        if (!(value >= -1.0 && value < OST_VTK_NAME) || value != floor(value))
            return 0;
        largest = fmax(largest, value);
    }
    return (int)largest + 1;
}

static int count_names(const char *name, char sign)
{
    int count = 1;
    for (; *name; name++)
        count += *name == sign;
    return count;
}

/* meshio puts the first of the signs between names that none of them contains: those before it in the list must be in
 * the array's name. "cell_id" of two numbers is no pair of sets: that would be "cell-id". */
static int may_be_between(const char *name, const char *sign)
{
    int may = 1;
    for (const char *before = signs; before < sign; before++)
        may &= strchr(name, *before) != NULL;
    return may;
}

/* The first sign, from `s` on, by which the array has as many names as numbers; '\0': none. */
static char find_sign(const OstVtkArray *array, int numbers, const char *s)
{
    while (*s && !(count_names(array->name, *s) == numbers && may_be_between(array->name, s)))
        s++;
    return *s;
}

/* Has the array as many names as it has numbers? Then *sign stands between them (0: there is one name). */
static int is_of_sets(const OstVtkArray *array, char *sign)
{
    const int numbers = count_numbers(array);
    *sign = '\0';
    if (numbers <= 1 || strlen(array->name) + 1 >= OST_VTK_NAME)
        return numbers == 1;
    *sign = find_sign(array, numbers, signs);
    return *sign != '\0';
}

/* meshio writes sets behind all else. */
const OstVtkArray *ost_vtk_sets(const OstVtkGrid *grid, int on_points, char *sign)
{
    const OstGlobal tuples = on_points ? grid->points : grid->cells;
    for (int a = grid->by_meshio ? grid->array_count - 1 : -1; a >= 0; a--) {
        const OstVtkArray *array = &grid->array[a];
        if (array->on_points == on_points && array->components == 1 && array->tuples == tuples &&
            strcmp(array->name, ost_vtk_ghosts) != 0 && is_of_sets(array, sign))
            return array;
    }
    return NULL;
}

/* The name of a set, which `rest` begins with, without the sign behind it. */
static const char *take_name(const char *rest, char sign, char name[OST_VTK_NAME])
{
    const char *end = sign ? strchr(rest, sign) : NULL;
    const size_t length = end ? (size_t)(end - rest) : strlen(rest);
    memcpy(name, rest, length);
    name[length] = '\0';
    return end ? end + 1 : NULL;
}

/* Whole numbers of another meaning may look like sets; and "a-1_b" is of the sets a and 1_b, or of a-1 and b. */
static void say(const OstVtkGrid *grid, const OstVtkArray *array, char sign)
{
    const char *const what = array->on_points ? "points" : "cells";
    const int count = sign ? count_names(array->name, sign) : 1;
    ost_log(grid->ctx, OST_LOG_VERBOSE, "%s: the numbers '%s' of %s are taken for %d of meshio's sets", grid->path,
            array->name, what, count);
    if (sign && find_sign(array, count, strchr(signs, sign) + 1))
        ost_warn(grid->ctx,
                 "%s: the sets of %s in '%s' have their names before and after each '%c', or each '%c': the first is "
                 "taken; to have the other, rename the sets before meshio writes them",
                 grid->path, what, array->name, sign, find_sign(array, count, strchr(signs, sign) + 1));
}

OstStatus ost_vtk_name_sets(const OstVtkGrid *grid, const OstVtkArray *array, char sign, OstCells *cells)
{
    char name[OST_VTK_NAME];
    OstGlobal number = 0;
    say(grid, array, sign);
    for (const char *rest = array->name; rest; number++) {
        rest = take_name(rest, sign, name);
        OST_TRY(ost_cells_name(cells, -1, number, name));
    }
    return OST_SUCCESS;
}

OstStatus ost_vtk_take_point_sets(const OstVtkGrid *grid, OstCells *cells)
{
    char sign, name[OST_VTK_NAME];
    const OstVtkArray *array = ost_vtk_sets(grid, 1, &sign);
    OstGlobal number = 0;
    if (array)
        say(grid, array, sign);
    for (const char *rest = array ? array->name : NULL; rest; number++) {
        int set = 0;
        rest = take_name(rest, sign, name);
        OST_TRY(ost_cells_set(cells, OST_SET_OF_NODES, name, &set));
        for (OstGlobal p = 0; p < grid->points; p++)
            if (array->values[p] == (double)number)
                OST_TRY(ost_cells_put(cells, set, p + 1));
    }
    return OST_SUCCESS;
}
