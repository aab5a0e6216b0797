/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/yaml/read.h"

#include "core/error.h"
#include "core/number_range.h"
#include "core/small.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

OstPlace ost_yaml_at(const OstYamlNode *node)
{
    return (OstPlace){(int)node->line + 1, (int)node->column + 1};
}

static const char *scalar_text(const OstYaml *yaml, const OstYamlNode *node)
{
    return yaml->text + ost_yaml_follow(yaml, node)->value;
}

/* No value: nothing after the colon, ~ or null. */
static int is_empty(const OstYaml *yaml, const OstYamlNode *node)
{
    if (!ost_yaml_is(yaml, node, OST_YAML_SCALAR) || ost_yaml_follow(yaml, node)->quoted)
        return 0;
    const char *text = scalar_text(yaml, node);
    return text[0] == 0 || strcmp(text, "~") == 0 || strcmp(text, "null") == 0;
}

enum { MOST_KEYS = 32 };

static int key_names(const OstYamlKey *keys, int count, const char *names[MOST_KEYS])
{
    const int listed = count < MOST_KEYS ? count : MOST_KEYS;
    for (int k = 0; k < listed; k++)
        names[k] = keys[k].name;
    return listed;
}

static const char *list_keys(const OstYamlKey *keys, int count, char *list, size_t size)
{
    const char *names[MOST_KEYS];
    const int listed = key_names(keys, count, names);
    ost_yaml_name_list(names, listed, list, size);
    return list;
}

/* What users of other programs write, and what it is here. */
static const char *word_for(const char *word, const char *const *names, int count)
{
    static const char *const other[][2] = {
        {"E", "youngs_modulus"},   {"nu", "poissons_ratio"},    {"G", "shear_modulus"},
        {"rho", "density"},        {"supports", "constraints"}, {"boundary_conditions", "constraints"},
        {"fixed", "displacement"}, {"direction", "fibre"},      {"thermal_expansion", "eigenstrain"},
        {"max", "largest"},        {"maximum", "largest"},      {"min", "least"},
        {"minimum", "least"},      {"strain", "strain_tensor"},
    };
    for (size_t o = 0; o < sizeof other / sizeof *other; o++)
        for (int n = 0; n < count && strcmp(word, other[o][0]) == 0; n++)
            if (strcmp(names[n], other[o][1]) == 0)
                return names[n];
    return ost_nearest_word(word, names, count);
}

static OstStatus raise_unknown_key(const OstYaml *yaml, const OstYamlNode *mapping, const OstYamlNode *key,
                                   const OstYamlKey *keys, int count)
{
    char place[OST_YAML_PLACE_SIZE];
    char list[OST_YAML_LIST_SIZE];
    const char *names[MOST_KEYS];
    const int listed = key_names(keys, count, names);
    const char *word = scalar_text(yaml, key);
    const char *nearest = word_for(word, names, listed);
    if (strcmp(word, "<<") == 0)
        return ost_yaml_raise(yaml, key, "'<<' merges mappings in YAML 1.1 alone; write their keys out");
    if (word[0] && word[strspn(word, "0123456789")] == '\0')
        return ost_yaml_raise(yaml, key, "unknown key '%.80s' in %s; decimals follow a point, and no comma: 0.3", word,
                              ost_yaml_place(yaml, mapping, place, sizeof place));
    return ost_yaml_raise(yaml, key, "unknown key '%.80s' in %s%s%s%s Known keys: %s", word,
                          ost_yaml_place(yaml, mapping, place, sizeof place), nearest ? "; did you mean '" : ".",
                          nearest ? nearest : "", nearest ? "'?" : "", list_keys(keys, count, list, sizeof list));
}

static OstStatus take_pair(const OstYaml *yaml, const OstYamlNode *mapping, const OstYamlNode *key,
                           const OstYamlNode *value, OstYamlKey *keys, int count)
{
    char place[OST_YAML_PLACE_SIZE];
    if (!ost_yaml_is(yaml, key, OST_YAML_SCALAR))
        return ost_yaml_raise(yaml, key, "found a list or mapping, expected a key");
    const char *name = scalar_text(yaml, key);
    int found = 0;
    while (found < count && strcmp(keys[found].name, name) != 0)
        found++;
    if (found == count)
        return raise_unknown_key(yaml, mapping, key, keys, count);
    if (keys[found].value)
        return ost_yaml_raise(yaml, key, "key '%s' occurs twice in %s, the first time in line %d; keep one", name,
                              ost_yaml_place(yaml, mapping, place, sizeof place), ost_yaml_line(keys[found].value));
    if (is_empty(yaml, value))
        return ost_yaml_raise(yaml, key, "key '%s' in %s has no value; give it one, or leave the key out", name,
                              ost_yaml_place(yaml, mapping, place, sizeof place));
    keys[found].value = value;
    return OST_SUCCESS;
}

/* Does a name with an ending stand where a mapping with the key 'file' is expected? */
static int is_file_name(const OstYaml *yaml, const OstYamlNode *node, const OstYamlKey *keys, int count)
{
    int has_file = 0;
    for (int k = 0; k < count; k++)
        has_file |= strcmp(keys[k].name, "file") == 0;
    return has_file && node->kind == OST_YAML_SCALAR && strchr(scalar_text(yaml, node), '.') != NULL;
}

OstStatus ost_yaml_mapping(const OstYaml *yaml, const OstYamlNode *node, OstYamlKey *keys, int count)
{
    char place[OST_YAML_PLACE_SIZE];
    const OstYamlNode *mapping = ost_yaml_follow(yaml, node);
    if (mapping->kind != OST_YAML_MAPPING) {
        char list[OST_YAML_LIST_SIZE], more[OST_YAML_LIST_SIZE + 64];
        snprintf(more, sizeof more, "%s%s", list_keys(keys, count, list, sizeof list),
                 is_file_name(yaml, mapping, keys, count) ? "; of a file: {file: NAME}" : "");
        return ost_yaml_raise_type(yaml, node, "a mapping with the keys", more);
    }
    const OstYamlNode *key = mapping + 1;
    for (uint32_t pair = 0; pair < mapping->value; pair++) {
        const OstYamlNode *value = ost_yaml_next(yaml, key);
        OST_TRY(take_pair(yaml, mapping, key, value, keys, count));
        key = ost_yaml_next(yaml, value);
    }
    for (int k = 0; k < count; k++)
        if (keys[k].needed && !keys[k].value)
            return ost_yaml_raise(yaml, node, "key '%s' is missing in %s", keys[k].name,
                                  ost_yaml_place(yaml, mapping, place, sizeof place));
    for (int k = 0; k < count; k++)
        if (keys[k].read && keys[k].value)
            OST_TRY(keys[k].read(yaml, keys[k].value, keys[k].into));
    return OST_SUCCESS;
}

int ost_yaml_has(const OstYaml *yaml, const OstYamlNode *node, const char *name)
{
    const OstYamlNode *mapping = ost_yaml_follow(yaml, node), *key = mapping + 1;
    for (uint32_t pair = 0; mapping->kind == OST_YAML_MAPPING && pair < mapping->value; pair++) {
        if (ost_yaml_is(yaml, key, OST_YAML_SCALAR) && strcmp(scalar_text(yaml, key), name) == 0)
            return 1;
        key = ost_yaml_next(yaml, ost_yaml_next(yaml, key));
    }
    return 0;
}

OstStatus ost_yaml_one_of(const OstYaml *yaml, const OstYamlNode *node, const OstYamlKey *keys, int count, int *which)
{
    char list[OST_YAML_LIST_SIZE];
    char place[OST_YAML_PLACE_SIZE];
    int second = -1;
    *which = -1;
    for (int k = count - 1; k >= 0; k--)
        if (keys[k].value) {
            second = *which;
            *which = k;
        }
    if (*which >= 0 && second < 0)
        return OST_SUCCESS;
    list_keys(keys, count, list, sizeof list);
    ost_yaml_place(yaml, ost_yaml_follow(yaml, node), place, sizeof place);
    if (*which < 0)
        return ost_yaml_raise(yaml, node, "%s has none of %s; exactly one of them is expected", place, list);
    return ost_yaml_raise(yaml, node, "%s has both '%s' and '%s'; exactly one of %s is expected", place,
                          keys[*which].name, keys[second].name, list);
}

OstStatus ost_yaml_list(const OstYaml *yaml, const OstYamlNode *node, const char *expected, int *count)
{
    *count = 0;
    if (!ost_yaml_is(yaml, node, OST_YAML_SEQUENCE))
        return ost_yaml_raise_type(yaml, node, expected, "");
    *count = (int)ost_yaml_follow(yaml, node)->value;
    return OST_SUCCESS;
}

OstStatus ost_yaml_short_list(const OstYaml *yaml, const OstYamlNode *node, const char *expected, int *count)
{
    OST_TRY(ost_yaml_list(yaml, node, expected, count));
    return *count <= OST_YAML_MOST_ENTRIES
               ? OST_SUCCESS
               : ost_yaml_raise(yaml, node, "found a list of %d, expected at most %d entries", *count,
                                OST_YAML_MOST_ENTRIES);
}

int ost_yaml_says(const OstYaml *yaml, const OstYamlNode *node, const char *word)
{
    return ost_yaml_is(yaml, node, OST_YAML_SCALAR) && strcmp(scalar_text(yaml, node), word) == 0;
}

OstStatus ost_yaml_text(const OstYaml *yaml, const OstYamlNode *node, const char **text)
{
    *text = NULL;
    if (!ost_yaml_is(yaml, node, OST_YAML_SCALAR) || scalar_text(yaml, node)[0] == 0)
        return ost_yaml_raise_type(yaml, node, "a text", "");
    for (const char *letter = scalar_text(yaml, node); *letter; letter++)
        if ((unsigned char)*letter < ' ' && *letter != '\n' && *letter != '\t')
            return ost_yaml_raise(yaml, node, "found the control character \\x%02x in a text; leave it out",
                                  (unsigned)*letter);
    *text = scalar_text(yaml, node);
    return OST_SUCCESS;
}

static int names_no_finite_number(const char *text)
{
    const char *word = text + (text[0] == '+' || text[0] == '-');
    word += word[0] == '.';
    return strncasecmp(word, "nan", 3) == 0 || strncasecmp(word, "inf", 3) == 0;
}

OstStatus ost_yaml_number(const OstYaml *yaml, const OstYamlNode *node, double *number)
{
    *number = 0.0;
    if (!ost_yaml_is(yaml, node, OST_YAML_SCALAR))
        return ost_yaml_raise_type(yaml, node, "a number", "");
    const char *text = scalar_text(yaml, node);
    if (ost_yaml_follow(yaml, node)->quoted)
        return ost_yaml_raise_type(yaml, node, "a number", " without quotes");
    if (names_no_finite_number(text))
        return ost_yaml_raise_type(yaml, node, "a finite number", "");
    char *end = NULL;
    *number = strtod(text, &end);
    if (end == text || strspn(text, "0123456789+-.eE") < (size_t)(end - text))
        return ost_yaml_raise_type(yaml, node, "a number", "");
    if (*end != 0)
        return ost_yaml_raise_type(yaml, node, "a number with nothing after it",
                                   " (write no units; use consistent ones)");
    if (!isfinite(*number))
        return ost_yaml_raise_type(yaml, node, "a finite number", " (below 1.8e308)");
    if (fabs(*number) > OST_MOST_NUMBER)
        return ost_yaml_raise_type(yaml, node, "a number of at most 1e75 in size",
                                   "(squares of larger ones leave double precision; choose other units)");
    return OST_SUCCESS;
}

OstStatus ost_yaml_positive(const OstYaml *yaml, const OstYamlNode *node, double *number)
{
    OST_TRY(ost_yaml_number(yaml, node, number));
    if (*number > 0.0 && *number < OST_LEAST_NUMBER)
        return ost_yaml_raise_type(yaml, node, "a number of at least 1e-75",
                                   "(squares of smaller ones leave double precision; choose other units)");
    return *number > 0.0 ? OST_SUCCESS : ost_yaml_raise_type(yaml, node, "a number above 0", "");
}

static OstStatus raise_integer(const OstYaml *yaml, const OstYamlNode *node, int64_t low, int64_t high)
{
    char range[64];
    snprintf(range, sizeof range, "from %lld to %lld", (long long)low, (long long)high);
    return ost_yaml_raise_type(yaml, node, "a whole number", range);
}

OstStatus ost_yaml_integer(const OstYaml *yaml, const OstYamlNode *node, int64_t low, int64_t high, int64_t *number)
{
    *number = 0;
    if (!ost_yaml_is(yaml, node, OST_YAML_SCALAR) || ost_yaml_follow(yaml, node)->quoted)
        return raise_integer(yaml, node, low, high);
    const char *text = scalar_text(yaml, node);
    const size_t sign = text[0] == '-' || text[0] == '+';
    const size_t digits = strspn(text + sign, "0123456789");
    if (digits == 0 || digits > 18 || text[sign + digits] != 0)
        return raise_integer(yaml, node, low, high);
    *number = strtoll(text, NULL, 10);
    return *number >= low && *number <= high ? OST_SUCCESS : raise_integer(yaml, node, low, high);
}

OstStatus ost_yaml_numbers(const OstYaml *yaml, const OstYamlNode *node, int count, double *numbers)
{
    char expected[64];
    int found;
    snprintf(expected, sizeof expected, "a list of %d numbers", count);
    OST_TRY(ost_yaml_list(yaml, node, expected, &found));
    if (found != count)
        return ost_yaml_raise_type(yaml, node, expected, "");
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item))
        OST_TRY(ost_yaml_number(yaml, item, &numbers[i]));
    return OST_SUCCESS;
}

OstStatus ost_yaml_positives(const OstYaml *yaml, const OstYamlNode *node, int count, double *numbers)
{
    OST_TRY(ost_yaml_numbers(yaml, node, count, numbers));
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item))
        OST_TRY(ost_yaml_positive(yaml, item, &numbers[i]));
    return OST_SUCCESS;
}

OstStatus ost_yaml_vector(const OstYaml *yaml, const OstYamlNode *node, double vector[3])
{
    return ost_yaml_numbers(yaml, node, 3, vector);
}

OstStatus ost_yaml_direction(const OstYaml *yaml, const OstYamlNode *node, double direction[3])
{
    OST_TRY(ost_yaml_numbers(yaml, node, 3, direction));
    const double largest = fmax(fabs(direction[0]), fmax(fabs(direction[1]), fabs(direction[2])));
    if (largest == 0.0)
        return ost_yaml_raise(yaml, node, "found the vector 0 0 0, expected a direction: three numbers not all zero");
    for (int i = 0; i < 3; i++) /* twice, so that no length overflows */
        direction[i] /= largest;
    const double length = ost_norm3(direction);
    for (int i = 0; i < 3; i++)
        direction[i] /= length;
    return OST_SUCCESS;
}

OstStatus ost_yaml_word(const OstYaml *yaml, const OstYamlNode *node, const char *what, const char *const *words,
                        int count, int *which)
{
    char list[OST_YAML_LIST_SIZE];
    ost_yaml_name_list(words, count, list, sizeof list);
    *which = -1;
    if (!ost_yaml_is(yaml, node, OST_YAML_SCALAR))
        return ost_yaml_raise_type(yaml, node, "one of", list);
    const char *text = scalar_text(yaml, node);
    for (int w = 0; w < count; w++)
        if (strcmp(words[w], text) == 0 || (strcmp(words[w], "on") == 0 && strcmp(text, "true") == 0) ||
            (strcmp(words[w], "off") == 0 && strcmp(text, "false") == 0)) /* as Python's yaml reads and writes them */
            *which = w;
    if (*which >= 0)
        return OST_SUCCESS;
    const char *nearest = word_for(text, words, count);
    if (nearest)
        return ost_yaml_raise(yaml, node, "unknown %s '%.80s'; did you mean '%s'? Known: %s", what, text, nearest,
                              list);
    return ost_yaml_raise(yaml, node, "unknown %s '%.80s'. Known: %s", what, text, list);
}
