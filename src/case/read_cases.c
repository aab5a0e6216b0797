/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "case/yaml/message.h"
#include "core/error.h"
#include "core/memory.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* --- cases --- */

enum { MOST_LOAD_CASES = 1000, LONGEST_NAME = 60 };

/* Names are part of file names. */
static OstStatus read_name(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstLoadCase *load_case)
{
    const char *name;
    OST_TRY(ost_yaml_text(yaml, node, &name));
    int plain = strlen(name) <= LONGEST_NAME && name[0] != '.';
    for (const char *letter = name; *letter; letter++)
        plain &= isalnum((unsigned char)*letter) || strchr("-_.+", *letter) != NULL;
    if (!plain)
        return ost_yaml_raise(yaml, node,
                              "the name '%.80s' is part of a file's name: letters, digits and - _ . + are possible, %d "
                              "at most",
                              name, LONGEST_NAME);
    for (const OstLoadCase *other = c->load_cases; other < load_case; other++)
        if (strcasecmp(other->name, name) == 0)
            return ost_yaml_raise(yaml, node, "the load case '%s' is there already, in line %d; choose another name",
                                  name, other->line);
    return ost_copy_string(yaml->ctx, name, &load_case->name);
}

enum { NAME, LOADS, COMBINE, CONSTRAINTS, SPRINGS, WATCH, ENTRY_KEYS };

static OstStatus read_entry(const OstYaml *yaml, const OstYamlNode *node, OstYamlKey keys[ENTRY_KEYS])
{
    static const OstYamlKey known[ENTRY_KEYS] = {
        [NAME] = {.name = "name", .needed = 1},  [LOADS] = {.name = "loads"},     [COMBINE] = {.name = "combine"},
        [CONSTRAINTS] = {.name = "constraints"}, [SPRINGS] = {.name = "springs"}, [WATCH] = {.name = "watch"},
    };
    memcpy(keys, known, sizeof known);
    return ost_yaml_mapping(yaml, node, keys, ENTRY_KEYS);
}

/* A constraint of a load case stands in place of one for all cases on the same selection. */
static void drop_replaced(OstCase *c, int before)
{
    int kept = 0;
    for (int i = 0; i < c->constraint_count; i++) {
        int replaced = 0;
        for (int k = before; k < c->constraint_count && i < before; k++)
            replaced |= (c->constraints[i].kind == OST_CONSTRAIN_PERIODIC) ==
                            (c->constraints[k].kind == OST_CONSTRAIN_PERIODIC) &&
                        ost_selections_agree(&c->constraints[i].on, &c->constraints[k].on);
        if (replaced)
            ost_constraint_release(&c->constraints[i]);
        else
            c->constraints[kept++] = c->constraints[i];
    }
    for (int i = kept; i < c->constraint_count; i++) /* moved from */
        memset(&c->constraints[i], 0, sizeof c->constraints[i]);
    c->constraint_count = kept;
}

/* What acts on the body in one load case, beside what acts in all. */
static OstStatus add_conditions(const OstYaml *yaml, const OstYamlKey keys[ENTRY_KEYS], OstCase *c)
{
    const int before = c->constraint_count, common_loads = c->load_count;
    if (keys[LOADS].value)
        OST_TRY(ost_read_loads(yaml, keys[LOADS].value, c));
    for (int i = common_loads; i < c->load_count; i++)
        c->loads[i].chosen = 1;
    if (keys[CONSTRAINTS].value)
        OST_TRY(ost_read_constraints(yaml, keys[CONSTRAINTS].value, c));
    if (keys[SPRINGS].value)
        OST_TRY(ost_read_springs(yaml, keys[SPRINGS].value, c));
    if (c->free_body && c->constraint_count > 0 && keys[CONSTRAINTS].value)
        return ost_yaml_raise(yaml, keys[CONSTRAINTS].value,
                              "a free body has no constraints, neither those of all cases nor of one");
    drop_replaced(c, before);
    return OST_SUCCESS;
}

/* `node`: the factor. */
static OstStatus multiply(const OstYaml *yaml, const OstYamlNode *node, double factor, OstLoad *load)
{
    if (load->exact)
        return ost_yaml_raise(yaml, node, "the load in line %d is by a formula (exact), which has no factor",
                              load->line);
    if (load->kind == OST_LOAD_CENTRIFUGAL && factor < 0.0)
        return ost_yaml_raise(yaml, node, "the centrifugal load in line %d cannot act inwards; its factor is 0 or more",
                              load->line);
    for (int i = 0; i < 3; i++)
        load->vector[i] *= factor;
    for (int i = 0; i < 6; i++)
        load->motion[i] *= factor;
    load->pressure *= factor;
    load->speed *= sqrt(fmax(factor, 0.0)); /* whose square the load grows with */
    return OST_SUCCESS;
}

/* Adds the loads of another load case, times a factor. */
static OstStatus add_combined(const OstYaml *yaml, const OstYamlKey *other, const OstYamlNode *item, OstCase *c)
{
    const int before = c->load_count;
    OstYamlKey keys[ENTRY_KEYS];
    OST_TRY(read_entry(yaml, item, keys));
    if (keys[COMBINE].value || keys[CONSTRAINTS].value || keys[SPRINGS].value)
        return ost_yaml_raise(yaml, other->value,
                              "'combine' adds loads alone, and '%.80s' has %s of its own; state its loads here",
                              other->name, keys[COMBINE].value ? "a combination" : "supports");
    if (keys[LOADS].value)
        OST_TRY(ost_read_loads(yaml, keys[LOADS].value, c));
    for (int i = before; i < c->load_count; i++) {
        c->loads[i].chosen = 1;
        OST_TRY(multiply(yaml, other->value, *other->into, &c->loads[i]));
    }
    return OST_SUCCESS;
}

/* `node` maps names of load cases to factors. */
static OstStatus combine(const OstYaml *yaml, const OstYamlNode *cases, int count, const OstYamlNode *node, OstCase *c)
{
    OstYamlKey *others = NULL, keys[ENTRY_KEYS];
    double *factor = NULL;
    const OstYamlNode *item = ost_yaml_first(yaml, cases);
    OstStatus status = OST_NEW(yaml->ctx, &others, count);
    OST_THEN(OST_NEW(yaml->ctx, &factor, count));
    for (int k = 0; k < count && status == OST_SUCCESS; k++, item = ost_yaml_next(yaml, item)) {
        status = read_entry(yaml, item, keys);
        OST_THEN(ost_yaml_text(yaml, keys[NAME].value, &others[k].name));
        others[k].read = ost_yaml_number;
        others[k].into = &factor[k];
    }
    OST_THEN(ost_yaml_mapping(yaml, node, others, count));
    item = ost_yaml_first(yaml, cases);
    for (int k = 0; k < count && status == OST_SUCCESS; k++, item = ost_yaml_next(yaml, item))
        if (others[k].value)
            status = add_combined(yaml, &others[k], item, c);
    OST_FREE(others);
    OST_FREE(factor);
    return status;
}

/* The title of a load case: that of the case, and its name. */
static OstStatus name_title(const char *name, OstCase *c)
{
    char *whole = NULL;
    const size_t size = strlen(c->title) + strlen(name) + 3;
    OST_TRY(OST_NEW(c->ctx, &whole, size));
    snprintf(whole, size, "%s: %s", c->title, name);
    OST_FREE(c->title);
    c->title = whole;
    return OST_SUCCESS;
}

OstStatus ost_read_load_cases(const OstYaml *yaml, const OstYamlNode *node, int number, OstCase *c)
{
    int count;
    const int all = number == OST_EVERY_LOAD_CASE;
    OstYamlKey keys[ENTRY_KEYS];
    OST_TRY(ost_yaml_list(yaml, node, "a list of load cases (- {name: wind, loads: ...})", &count));
    if (count < 1 || count > MOST_LOAD_CASES)
        return ost_yaml_raise(yaml, node, "found %d load cases, expected 1 to %d", count, MOST_LOAD_CASES);
    if (all) {
        OST_TRY(OST_NEW(yaml->ctx, &c->load_cases, count));
        c->load_case_count = count;
    }
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int k = 0; k < count; k++, item = ost_yaml_next(yaml, item)) {
        if (!all && k != number)
            continue;
        OST_TRY(read_entry(yaml, item, keys));
        if (all) {
            c->load_cases[k].line = ost_yaml_line(item);
            OST_TRY(read_name(yaml, keys[NAME].value, c, &c->load_cases[k]));
        } else {
            const char *name;
            OST_TRY(ost_yaml_text(yaml, keys[NAME].value, &name));
            OST_TRY(name_title(name, c));
            if (keys[WATCH].value)
                OST_TRY(ost_read_watches(yaml, keys[WATCH].value, c));
            if (keys[COMBINE].value)
                OST_TRY(combine(yaml, node, count, keys[COMBINE].value, c));
        }
        OST_TRY(add_conditions(yaml, keys, c));
    }
    return OST_SUCCESS;
}

OstStatus ost_check_envelope(const OstYaml *yaml, const OstYamlNode *cases, const OstYamlNode *output, OstCase *c)
{
    if (c->envelope && !cases)
        return ost_yaml_raise(yaml, output, "an envelope is of load cases, and there are none ('cases')");
    if (c->envelope)
        c->envelope = ost_yaml_line(output);
    for (int k = 0; c->envelope && k < c->load_case_count; k++)
        if (strcasecmp(c->load_cases[k].name, "envelope") == 0)
            return ost_yaml_raise(yaml, output,
                                  "the file of the envelope has the name of the load case '%s', in line %d; "
                                  "choose another name",
                                  c->load_cases[k].name, c->load_cases[k].line);
    return OST_SUCCESS;
}

OstStatus ost_case_check_envelope(const OstCase *c)
{
    return c->envelope && c->asks_error
               ? OST_RAISE(c->ctx, OST_INVALID_INPUT,
                           "%s:%d: an envelope needs one mesh for all load cases, and an accuracy that is asked for "
                           "gives each its own; leave out 'envelope' or 'relative_error', or take one load case with "
                           "--case",
                           c->path, c->envelope)
               : OST_SUCCESS;
}

/* Are 'a' with probe 'x_l' and 'a_x' with 'l' one file? `longer` begins with `shorter` and an underscore. */
static int share_file(const char *shorter, const OstProbe *of_shorter, const char *longer, const OstProbe *of_longer)
{
    const char *rest = longer + strlen(shorter) + 1;
    const size_t length = strlen(rest);
    return strncasecmp(of_shorter->name, rest, length) == 0 && of_shorter->name[length] == '_' &&
           strcasecmp(of_shorter->name + length + 1, of_longer->name) == 0;
}

static OstStatus check_probes_of(const OstYaml *yaml, const OstYamlNode *output, const OstCase *c,
                                 const OstLoadCase *shorter, const OstLoadCase *longer)
{
    const size_t length = strlen(shorter->name);
    if (strncasecmp(shorter->name, longer->name, length) != 0 || longer->name[length] != '_')
        return OST_SUCCESS;
    for (int p = 0; p < c->probe_count; p++)
        for (int q = 0; q < c->probe_count; q++)
            if (share_file(shorter->name, &c->probes[p], longer->name, &c->probes[q]))
                return ost_yaml_raise(yaml, output,
                                      "the tables of the probe '%s' in the load case '%s', in line %d, and of '%s' in "
                                      "'%s' have the same file name; choose another name",
                                      c->probes[p].name, shorter->name, shorter->line, c->probes[q].name, longer->name);
    return OST_SUCCESS;
}

OstStatus ost_check_probe_files(const OstYaml *yaml, const OstYamlNode *output, const OstCase *c)
{
    for (int k = 0; k < c->load_case_count && c->probe_count > 0; k++)
        for (int other = 0; other < c->load_case_count; other++)
            OST_TRY(check_probes_of(yaml, output, c, &c->load_cases[k], &c->load_cases[other]));
    return OST_SUCCESS;
}

void ost_load_cases_release(OstCase *c)
{
    for (int k = 0; k < c->load_case_count; k++) {
        OST_FREE(c->load_cases[k].name);
        ost_case_destroy(&c->load_cases[k].c);
    }
    OST_FREE(c->load_cases);
}

OstStatus ost_case_pick(OstCase **c, const char *name)
{
    enum { MOST_NAMES = 40 };
    OstCase *whole = *c;
    const char *names[MOST_NAMES];
    char list[OST_YAML_LIST_SIZE];
    int count = 0;
    for (int k = 0; k < whole->load_case_count; k++) {
        OstLoadCase *load_case = &whole->load_cases[k];
        if (strcmp(load_case->name, name) == 0) {
            *c = load_case->c;
            load_case->c = NULL;
            (*c)->envelope = 0;
            ost_case_destroy(&whole);
            return OST_SUCCESS;
        }
        if (count < MOST_NAMES)
            names[count++] = load_case->name;
    }
    if (count == 0)
        return OST_RAISE(whole->ctx, OST_INVALID_USAGE,
                         "%s: there are no load cases (cases: ...), so none is called '%s'", whole->path, name);
    const char *nearest = ost_nearest_word(name, names, count);
    ost_yaml_name_list(names, count, list, sizeof list);
    return OST_RAISE(whole->ctx, OST_INVALID_USAGE, "%s: there is no load case '%s'%s%s%s There are: %s", whole->path,
                     name, nearest ? "; did you mean '" : ".", nearest ? nearest : "", nearest ? "'?" : "", list);
}

int ost_case_load_case_count(const OstCase *c)
{
    return c->load_case_count;
}

const OstCase *ost_case_load_case(const OstCase *c, int number)
{
    return c->load_cases[number].c;
}

const char *ost_case_load_case_name(const OstCase *c, int number)
{
    return c->load_cases[number].name;
}

/* --- sweep --- */

enum { MOST_SWEEP_VALUES = 1000 };

static OstStatus copy_value(const OstYaml *yaml, const char *text, OstSweepKey *key)
{
    return ost_copy_string(yaml->ctx, text, &key->value[key->count++]);
}

/* So many numbers at equal distances. */
static OstStatus read_range(const OstYaml *yaml, const OstYamlNode *node, OstSweepKey *key)
{
    enum { FROM, TO, COUNT, KEYS };
    double ends[2] = {0.0};
    OstYamlKey keys[KEYS] = {
        [FROM] = {.name = "from", .needed = 1, .read = ost_yaml_number, .into = &ends[0]},
        [TO] = {.name = "to", .needed = 1, .read = ost_yaml_number, .into = &ends[1]},
        [COUNT] = {.name = "count", .needed = 1},
    };
    int64_t count;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, KEYS));
    OST_TRY(ost_yaml_integer(yaml, keys[COUNT].value, 2, MOST_SWEEP_VALUES, &count));
    OST_TRY(OST_NEW(yaml->ctx, &key->value, count));
    for (int i = 0; i < (int)count; i++) {
        char text[32];
        snprintf(text, sizeof text, "%.12g", ends[0] + (ends[1] - ends[0]) * i / (double)(count - 1));
        OST_TRY(copy_value(yaml, text, key));
    }
    return OST_SUCCESS;
}

static OstStatus read_values(const OstYaml *yaml, const OstYamlNode *node, OstSweepKey *key)
{
    int count;
    if (ost_yaml_is(yaml, node, OST_YAML_MAPPING))
        return read_range(yaml, node, key);
    OST_TRY(ost_yaml_list(yaml, node, "a list of values, or {from: 1, to: 2, count: 5}", &count));
    if (count < 1 || count > MOST_SWEEP_VALUES)
        return ost_yaml_raise(yaml, node, "found %d values, expected 1 to %d", count, MOST_SWEEP_VALUES);
    OST_TRY(OST_NEW(yaml->ctx, &key->value, count));
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item)) {
        const char *text;
        OST_TRY(ost_yaml_text(yaml, item, &text));
        OST_TRY(copy_value(yaml, text, key));
    }
    return OST_SUCCESS;
}

OstStatus ost_read_sweep(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    if (!ost_yaml_is(yaml, node, OST_YAML_MAPPING))
        return ost_yaml_raise_type(yaml, node, "keys and their values, as in materials.wood.E1: [9e9, 11e9]", "");
    const int count = (int)ost_yaml_follow(yaml, node)->value;
    OST_TRY(OST_NEW(yaml->ctx, &c->sweep, count));
    const OstYamlNode *key = ost_yaml_first(yaml, node);
    for (int k = 0; k < count; k++) {
        const OstYamlNode *value = ost_yaml_next(yaml, key);
        c->sweep_count = k + 1;
        OST_TRY(ost_read_string(yaml, key, &c->sweep[k].key));
        OST_TRY(read_values(yaml, value, &c->sweep[k]));
        key = ost_yaml_next(yaml, value);
    }
    return OST_SUCCESS;
}

void ost_sweep_release(OstCase *c)
{
    for (int k = 0; k < c->sweep_count; k++) {
        OST_FREE_EACH(c->sweep[k].count, c->sweep[k].value);
        OST_FREE(c->sweep[k].key);
    }
    OST_FREE(c->sweep);
}
