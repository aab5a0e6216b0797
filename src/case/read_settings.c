/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "case/yaml/message.h"
#include "core/error.h"
#include "core/memory.h"

#include <string.h>

OstStatus ost_read_element(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    OstYamlKey keys[] = {{"order", OST_OPTIONAL, NULL}};
    int64_t order = 0;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, 1));
    if (keys[0].value)
        OST_TRY(ost_yaml_integer(yaml, keys[0].value, 1, 2, &order));
    c->order = (int)order;
    return OST_SUCCESS;
}

OstStatus ost_read_accuracy(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    static const char *const words[] = {"refuse", "accept"};
    enum { RESIDUAL, OUT_OF_REACH };
    OstYamlKey keys[] = {
        [RESIDUAL] = {"relative_residual", OST_OPTIONAL, NULL}, [OUT_OF_REACH] = {"out_of_reach", OST_OPTIONAL, NULL}};
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    if (keys[RESIDUAL].value)
        c->solver.accept_attainable = 0;
    if (keys[OUT_OF_REACH].value)
        OST_TRY(ost_yaml_word(yaml, keys[OUT_OF_REACH].value, "answer", words, 2, &c->solver.accept_attainable));
    if (!keys[RESIDUAL].value)
        return OST_SUCCESS;
    OST_TRY(ost_yaml_number(yaml, keys[RESIDUAL].value, &c->solver.relative_residual));
    if (!(c->solver.relative_residual >= 1e-15 && c->solver.relative_residual <= 0.5))
        return ost_yaml_raise_type(yaml, keys[RESIDUAL].value, "a number from 1e-15 to 0.5", "");
    return OST_SUCCESS;
}

/* The bounds of ost_solver_check_options, tested here to name the line. */
static const double most_aggregate = 1e6, most_block = 1e3, most_ratio = 1e6, most_mebibytes = 1e12;

static OstStatus read_aggregate(const OstYaml *yaml, const OstYamlKey *key, double *nodes)
{
    if (!key->value)
        return OST_SUCCESS;
    OST_TRY(ost_yaml_number(yaml, key->value, nodes));
    return *nodes > 1.0 && *nodes <= most_aggregate
               ? OST_SUCCESS
               : ost_yaml_raise_type(yaml, key->value, "a number of nodes above 1, at most 1e6", "");
}

static OstStatus read_block(const OstYaml *yaml, const OstYamlKey *key, double *nodes)
{
    if (!key->value)
        return OST_SUCCESS;
    OST_TRY(ost_yaml_number(yaml, key->value, nodes));
    return *nodes >= 1.0 && *nodes <= most_block
               ? OST_SUCCESS
               : ost_yaml_raise_type(yaml, key->value, "a number of nodes from 1 to 1000", "");
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

enum { METHOD, ITERATIONS, PATIENCE, AGGREGATE, COARSE, BLOCK, DEGREE, RATIO, COARSEST, LEVELS, MEMORY, SOLVER_KEYS };

static OstStatus read_ratio(const OstYaml *yaml, const OstYamlKey *key, double *ratio)
{
    if (!key->value)
        return OST_SUCCESS;
    OST_TRY(ost_yaml_number(yaml, key->value, ratio));
    return *ratio > 1.0 && *ratio <= most_ratio
               ? OST_SUCCESS
               : ost_yaml_raise_type(yaml, key->value, "a number above 1, at most 1e6", "");
}

static OstStatus read_memory(const OstYaml *yaml, const OstYamlKey *key, double *bytes)
{
    double mebibytes = 0.0;
    if (!key->value)
        return OST_SUCCESS;
    OST_TRY(ost_yaml_number(yaml, key->value, &mebibytes));
    *bytes = 1048576.0 * mebibytes;
    return mebibytes > 0.0 && mebibytes <= most_mebibytes
               ? OST_SUCCESS
               : ost_yaml_raise_type(yaml, key->value, "a number of MiB above 0, at most 1e12", "");
}

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
        [METHOD] = {"method", OST_OPTIONAL, NULL},
        [ITERATIONS] = {"max_iterations", OST_OPTIONAL, NULL},
        [PATIENCE] = {"patience", OST_OPTIONAL, NULL},
        [AGGREGATE] = {"aggregate_nodes", OST_OPTIONAL, NULL},
        [COARSE] = {"coarse_aggregate_nodes", OST_OPTIONAL, NULL},
        [BLOCK] = {"smoother_block_nodes", OST_OPTIONAL, NULL},
        [DEGREE] = {"smoother_degree", OST_OPTIONAL, NULL},
        [RATIO] = {"smoother_ratio", OST_OPTIONAL, NULL},
        [COARSEST] = {"coarsest_unknowns", OST_OPTIONAL, NULL},
        [LEVELS] = {"most_levels", OST_OPTIONAL, NULL},
        [MEMORY] = {"factor_memory", OST_OPTIONAL, NULL},
    };
    OstSolverOptions *solver = &c->solver;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, SOLVER_KEYS));
    OST_TRY(read_method(yaml, &keys[METHOD], &solver->method));
    OST_TRY(read_count(yaml, &keys[ITERATIONS], 1000000, &solver->max_iterations));
    OST_TRY(read_count(yaml, &keys[PATIENCE], 1000000, &solver->patience));
    OST_TRY(read_aggregate(yaml, &keys[AGGREGATE], &solver->aggregate_nodes));
    OST_TRY(read_aggregate(yaml, &keys[COARSE], &solver->coarse_aggregate_nodes));
    OST_TRY(read_block(yaml, &keys[BLOCK], &solver->smoother_block_nodes));
    OST_TRY(read_count(yaml, &keys[DEGREE], 20, &solver->smoother_degree));
    OST_TRY(read_ratio(yaml, &keys[RATIO], &solver->smoother_ratio));
    OST_TRY(read_count(yaml, &keys[COARSEST], 1000000, &solver->coarsest_unknowns));
    OST_TRY(read_count(yaml, &keys[LEVELS], OST_MAX_LEVELS, &solver->most_levels));
    OST_TRY(read_memory(yaml, &keys[MEMORY], &solver->factor_memory));
    solver->given = fixed_settings(keys);
    return OST_SUCCESS;
}

static OstStatus read_fields(const OstYaml *yaml, const OstYamlNode *node, unsigned *fields)
{
#define FIELD_WORD(name, word) [name] = word,
    static const char *const words[OST_FIELD_COUNT] = {OST_OUTPUT_FIELD_TABLE(FIELD_WORD)};
#undef FIELD_WORD
    int count;
    OST_TRY(ost_yaml_short_list(yaml, node, "a list of fields", &count));
    *fields = 0;
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item)) {
        int field;
        OST_TRY(ost_yaml_word(yaml, item, "field", words, OST_FIELD_COUNT, &field));
        *fields |= 1U << field;
    }
    return OST_SUCCESS;
}

OstStatus ost_read_output(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    enum { FILE_NAME, FIELDS };
    OstYamlKey keys[] = {
        [FILE_NAME] = {"file", OST_OPTIONAL, NULL},
        [FIELDS] = {"fields", OST_OPTIONAL, NULL},
    };
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    if (keys[FIELDS].value)
        OST_TRY(read_fields(yaml, keys[FIELDS].value, &c->output_fields));
    if (!keys[FILE_NAME].value)
        return OST_SUCCESS;
    OST_TRY(ost_read_string(yaml, keys[FILE_NAME].value, &c->output_file));
    return ost_has_ending(c->output_file, ".vtkhdf")
               ? OST_SUCCESS
               : ost_yaml_raise_type(yaml, keys[FILE_NAME].value, "a name that ends with .vtkhdf", "");
}
