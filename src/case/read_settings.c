/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "case/yaml/message.h"
#include "core/error.h"
#include "formats/serial/output_array.h"

#include <float.h>
#include <math.h>
#include <string.h>

OstStatus ost_read_element(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    static const char *const words[] = {"false", "true"};
    static const char *const forms[] = {"auto", "off"};
    OstYamlKey keys[] = {{.name = "order"}, {.name = "straighten"}, {.name = "mixed"}};
    int64_t order = 0;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    if (keys[0].value)
        OST_TRY(ost_yaml_integer(yaml, keys[0].value, 1, 2, &order));
    if (keys[1].value)
        OST_TRY(ost_yaml_word(yaml, keys[1].value, "value", words, 2, &c->straighten));
    if (keys[2].value)
        OST_TRY(ost_yaml_word(yaml, keys[2].value, "answer", forms, 2, &c->unmixed));
    c->order = (int)order;
    return OST_SUCCESS;
}

OstStatus ost_read_large_rotation(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    static const char *const words[] = {
        [OST_LARGE_ROTATION_AUTO] = "auto", [OST_LARGE_ROTATION_ON] = "on", [OST_LARGE_ROTATION_OFF] = "off"};
    int which;
    OST_TRY(ost_yaml_word(yaml, node, "answer", words, OST_COUNT_OF(words), &which));
    c->large_rotation = (OstLargeRotation)which;
    return OST_SUCCESS;
}

/* A word, or a mapping with the number of modes. */
OstStatus ost_read_buckling(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    static const char *const words[] = {"off", "on"};
    OstYamlKey keys[] = {{.name = "modes", .needed = 1}};
    int64_t modes;
    if (!ost_yaml_is(yaml, node, OST_YAML_MAPPING))
        return ost_yaml_word(yaml, node, "answer", words, OST_COUNT_OF(words), &c->buckling_modes);
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_integer(yaml, keys[0].value, 1, OST_MOST_BUCKLING_MODES, &modes));
    c->buckling_modes = (int)modes;
    return OST_SUCCESS;
}

OstStatus ost_settle_buckling(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    if (c->buckling_modes > 0 && c->path_steps > 0)
        return ost_yaml_raise(yaml, node,
                              "the body buckles under the load of one linear answer, and a path has many; leave out "
                              "'buckling' or 'path'");
    if (c->buckling_modes > 0 && c->free_body)
        return ost_yaml_raise(yaml, node,
                              "a free body that is pressed turns round before it buckles; constrain six of its "
                              "components, or leave buckling out");
    for (int m = 0; m < c->buckling_modes && !c->named_fields; m++)
        c->output_fields |= 1U << (OST_FIELD_BUCKLING_MODE_1 + m);
    return OST_SUCCESS;
}

OstStatus ost_read_formulation(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    static const char *const words[] = {"consistent", "classical"};
    int which;
    OST_TRY(ost_yaml_word(yaml, node, "formulation", words, OST_COUNT_OF(words), &which));
    c->formulation = which == 0 ? OST_FORMULATION_CONSISTENT : OST_FORMULATION_CLASSICAL;
    return OST_SUCCESS;
}

/* The quantity that the error is of: "energy", or the name of a watched one. */
static OstStatus read_interest(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    const char *name;
    OST_TRY(ost_yaml_text(yaml, node, &name));
    for (int w = 0; w < c->watch_count; w++)
        if (strcmp(c->watches[w].name, name) == 0)
            c->interest = w + 1;
    if (strcmp(name, "energy") == 0 && c->interest == 0)
        return OST_SUCCESS;
    if (strcmp(name, "energy") == 0)
        return ost_yaml_raise(yaml, node,
                              "'energy' is the norm of the energy here, and the quantity watched in line %d has that "
                              "name too; give that one another name, or leave 'of' out for the norm",
                              c->watches[c->interest - 1].line);
    if (c->interest == 0)
        return ost_yaml_raise(
            yaml, node,
            "'%.80s' is not watched%s; name a quantity of the section 'watch', or energy for the norm of the energy",
            name,
            ost_yaml_has(yaml, yaml->node, "cases")
                ? " in all load cases: what 'cases' adds to one alone does not count, also where --case takes that "
                  "one"
                : "");
    if (ost_watch_is_of_stress(&c->watches[c->interest - 1]))
        return ost_yaml_raise(yaml, node,
                              "'%.80s' is a %s, for whose error no mesh is refined; name a displacement, a reaction or "
                              "the strain energy",
                              name, c->watches[c->interest - 1].kind == OST_WATCH_STRESS ? "stress" : "load factor");
    return OST_SUCCESS;
}

OstStatus ost_read_accuracy(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    static const char *const words[] = {"refuse", "accept"};
    enum { RESIDUAL, FRACTION, OUT_OF_REACH, ERROR, OF };
    OstYamlKey keys[] = {[RESIDUAL] = {.name = "relative_residual"},
                         [FRACTION] = {.name = "algebraic_fraction"},
                         [OUT_OF_REACH] = {.name = "out_of_reach"},
                         [ERROR] = {.name = "relative_error"},
                         [OF] = {.name = "of"}};
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    if (keys[RESIDUAL].value) {
        c->solver.accept_attainable = 0;
        c->solver.algebraic_fraction = 0.0;
    }
    if (keys[FRACTION].value)
        OST_TRY(ost_yaml_number(yaml, keys[FRACTION].value, &c->solver.algebraic_fraction));
    if (keys[FRACTION].value && !(c->solver.algebraic_fraction >= 0.0 && c->solver.algebraic_fraction <= 0.5))
        return ost_yaml_raise_type(yaml, keys[FRACTION].value, "a number from 0 to 0.5", "");
    if (keys[OUT_OF_REACH].value)
        OST_TRY(ost_yaml_word(yaml, keys[OUT_OF_REACH].value, "answer", words, 2, &c->solver.accept_attainable));
    c->asks_error = keys[ERROR].value != NULL;
    if (c->asks_error)
        OST_TRY(ost_yaml_number(yaml, keys[ERROR].value, &c->relative_error));
    if (!(c->relative_error > 0.0 && c->relative_error < 1.0))
        return ost_yaml_raise_type(yaml, keys[ERROR].value, "a number above 0 and below 1", "");
    if (keys[OF].value)
        OST_TRY(read_interest(yaml, keys[OF].value, c));
    if (!keys[RESIDUAL].value)
        return OST_SUCCESS;
    OST_TRY(ost_yaml_number(yaml, keys[RESIDUAL].value, &c->solver.relative_residual));
    if (!(c->solver.relative_residual >= 1e-15 && c->solver.relative_residual <= 0.5))
        return ost_yaml_raise_type(yaml, keys[RESIDUAL].value, "a number from 1e-15 to 0.5", "");
    return OST_SUCCESS;
}

static OstStatus read_count(const OstYaml *yaml, const OstYamlKey *key, int64_t high, int *count)
{
    int64_t number;
    if (!key->value)
        return OST_SUCCESS;
    OST_TRY(ost_yaml_integer(yaml, key->value, 1, high, &number));
    *count = (int)number;
    return OST_SUCCESS;
}

static OstStatus read_method(const OstYaml *yaml, const OstYamlKey *key, OstMethod *method)
{
    static const char *const words[] = {
        [OST_METHOD_AUTO] = "auto",     [OST_METHOD_PLAIN] = "plain",         [OST_METHOD_METRIC] = "metric",
        [OST_METHOD_STRONG] = "strong", [OST_METHOD_TWO_LEVEL] = "two_level", [OST_METHOD_DIRECT] = "direct",
    };
    int which;
    if (!key->value)
        return OST_SUCCESS;
    OST_TRY(ost_yaml_word(yaml, key->value, "method", words, OST_COUNT_OF(words), &which));
    *method = (OstMethod)which;
    return OST_SUCCESS;
}

enum {
    METHOD,
    ITERATIONS,
    PATIENCE,
    AGGREGATE,
    COARSE,
    BLOCK,
    DEGREE,
    RATIO,
    COARSEST,
    LEVELS,
    STEPS,
    MEMORY,
    SOLVER_KEYS
};

/* Which settings the case fixes, so that plan and strategies keep them. */
static unsigned fixed_settings(const OstYamlKey *keys)
{
    return (keys[AGGREGATE].value ? OST_GIVEN_AGGREGATE : 0U) | (keys[COARSE].value ? OST_GIVEN_COARSE_AGGREGATE : 0U) |
           (keys[BLOCK].value ? OST_GIVEN_BLOCK : 0U) | (keys[DEGREE].value ? OST_GIVEN_DEGREE : 0U) |
           (keys[RATIO].value ? OST_GIVEN_RATIO : 0U) | (keys[COARSEST].value ? OST_GIVEN_COARSEST : 0U);
}

OstStatus ost_read_solver(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    OstYamlKey keys[SOLVER_KEYS] = {
        [METHOD] = {.name = "method"},
        [ITERATIONS] = {.name = "max_iterations"},
        [PATIENCE] = {.name = "patience"},
        [AGGREGATE] = {.name = "aggregate_nodes"},
        [COARSE] = {.name = "coarse_aggregate_nodes"},
        [BLOCK] = {.name = "smoother_block_nodes"},
        [DEGREE] = {.name = "smoother_degree"},
        [RATIO] = {.name = "smoother_ratio"},
        [COARSEST] = {.name = "coarsest_unknowns"},
        [LEVELS] = {.name = "most_levels"},
        [STEPS] = {.name = "load_steps"},
        [MEMORY] = {.name = "factor_memory"},
    };
    OstSolverOptions *solver = &c->solver;
    double mebibytes = 0.0;
    /* The bounds of ost_solver_check_options, tested here to name the line. */
    const double above_1 = 1.0 + DBL_EPSILON;
    const struct {
        int key;
        double least, most;
        const char *expected;
        double *number;
    } numbers[] = {
        {AGGREGATE, above_1, 1e6, "a number of nodes above 1, at most 1e6", &solver->aggregate_nodes},
        {COARSE, above_1, 1e6, "a number of nodes above 1, at most 1e6", &solver->coarse_aggregate_nodes},
        {BLOCK, 1.0, 1e3, "a number of nodes from 1 to 1000", &solver->smoother_block_nodes},
        {RATIO, above_1, 1e6, "a number above 1, at most 1e6", &solver->smoother_ratio},
        {MEMORY, 0.0, 1e12, "a number of MiB from 0 to 1e12", &mebibytes},
    };
    OST_TRY(ost_yaml_mapping(yaml, node, keys, SOLVER_KEYS));
    for (int n = 0; n < OST_COUNT_OF(numbers); n++) {
        const OstYamlNode *value = keys[numbers[n].key].value;
        if (!value)
            continue;
        OST_TRY(ost_yaml_number(yaml, value, numbers[n].number));
        if (!(*numbers[n].number >= numbers[n].least && *numbers[n].number <= numbers[n].most))
            return ost_yaml_raise_type(yaml, value, numbers[n].expected, "");
    }
    if (keys[MEMORY].value)
        solver->factor_memory = fmax(1048576.0 * mebibytes, DBL_TRUE_MIN); /* an option of 0 is all that is free */
    OST_TRY(read_method(yaml, &keys[METHOD], &solver->method));
    OST_TRY(read_count(yaml, &keys[ITERATIONS], 1000000, &solver->max_iterations));
    OST_TRY(read_count(yaml, &keys[PATIENCE], 1000000, &solver->patience));
    OST_TRY(read_count(yaml, &keys[DEGREE], 20, &solver->smoother_degree));
    OST_TRY(read_count(yaml, &keys[COARSEST], 1000000, &solver->coarsest_unknowns));
    OST_TRY(read_count(yaml, &keys[LEVELS], OST_MAX_LEVELS, &solver->most_levels));
    OST_TRY(read_count(yaml, &keys[STEPS], 1000, &solver->load_steps));
    solver->given = fixed_settings(keys);
    return OST_SUCCESS;
}

static OstStatus read_fields(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
#define FIELD_WORD(name, word) [name] = word,
    static const char *const words[OST_FIELD_COUNT] = {OST_OUTPUT_FIELD_TABLE(FIELD_WORD)};
#undef FIELD_WORD
    int count;
    OST_TRY(ost_yaml_short_list(yaml, node, "a list of fields", &count));
    c->named_fields = 0;
    c->fields_line = ost_yaml_line(node);
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item)) {
        int field;
        OST_TRY(ost_yaml_word(yaml, item, "field", words, OST_FIELD_COUNT, &field));
        c->named_fields |= 1U << field;
    }
    c->output_fields = c->named_fields;
    return OST_SUCCESS;
}

OstStatus ost_read_output(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    enum { FILE_NAME, FIELDS, PROBES, ENVELOPE };
    OstYamlKey keys[] = {
        [FILE_NAME] = {.name = "file"},
        [FIELDS] = {.name = "fields"},
        [PROBES] = {.name = "probes"},
        [ENVELOPE] = {.name = "envelope"},
    };
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    if (keys[FIELDS].value)
        OST_TRY(read_fields(yaml, keys[FIELDS].value, c));
    if (keys[PROBES].value)
        OST_TRY(ost_read_probes(yaml, keys[PROBES].value, &c->probe_count, &c->probes));
    if (keys[ENVELOPE].value)
        OST_TRY(ost_yaml_word(yaml, keys[ENVELOPE].value, "answer", (const char *const[]){"false", "true"}, 2,
                              &c->envelope));
    if (!keys[FILE_NAME].value)
        return OST_SUCCESS;
    OST_TRY(ost_read_string(yaml, keys[FILE_NAME].value, &c->output_file));
    size_t stem;
    return ost_result_form(c->output_file, &stem) != OST_RESULT_FORMS
               ? OST_SUCCESS
               : ost_yaml_raise_type(yaml, keys[FILE_NAME].value, "a name that ends with " OST_RESULT_ENDINGS, "");
}
