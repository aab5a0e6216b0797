/* SPDX-License-Identifier: BSD-3-Clause */
#include "output/envelope.h"

#include "core/error.h"
#include "core/json_file.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "output/fields_file.h"
#include "recovery/derived.h"

#include <math.h>
#include <stdio.h>

enum { LONGEST_PATH = 4096, MOST_NAMED = 3 };

typedef enum { DISPLACEMENT, VON_MISES, PRINCIPAL, FACTORS, PARTS = FACTORS + OST_CRITERIA } Part;

static const struct {
    const char *field, *governing; /* names of arrays: fields/output_field.c says what they are */
    const char *label;
} about[PARTS] = {
    [DISPLACEMENT] = {"largest_displacement", "largest_displacement_case", "largest |u|"},
    [VON_MISES] = {"largest_von_mises", "largest_von_mises_case", "largest von Mises"},
    [PRINCIPAL] = {"largest_principal", "largest_principal_case", "largest principal"},
    [FACTORS + OST_TSAI_WU] = {"least_tsai_wu_load_factor", "least_tsai_wu_load_factor_case", "least factor, Tsai-Wu"},
    [FACTORS + OST_HILL] = {"least_hill_load_factor", "least_hill_load_factor_case", "least factor, Hill"},
    [FACTORS + OST_MAXIMUM_STRESS] = {"least_maximum_stress_load_factor", "least_maximum_stress_load_factor_case",
                                      "least factor, stress"},
};

/* What is extreme at each node, or in each tet; both arrays are NULL where it is left out. */
typedef struct Extremes {
    double *value;
    int32_t *governing; /* number of the load case, from 1; 0: none, as nothing fails */
    double most;        /* the extreme of the body */
    int by;             /* and whose it is */
    double *share;      /* of each load case: of the nodes or tets where it governs */
} Extremes;

struct OstEnvelope {
    OstContext *ctx;
    const OstCase *c;
    const OstMesh *mesh;
    int taken; /* results */
    Extremes of[PARTS];
    char file[LONGEST_PATH];
};

static OstLocal rows(const OstMesh *mesh, Part part)
{
    return part == DISPLACEMENT ? mesh->node_count : mesh->owned_tets;
}

/* Of values that only rounding tells apart, as those of mirrored loads, the one of the first load case counts. */
static int is_more(Part part, double value, int number, double than, int of)
{
    const double alike = 1e-9 * fabs(than), more = part < FACTORS ? value - than : than - value;
    return !isfinite(than) || of == 0 ? more > 0.0 : number < of ? more >= -alike : more > alike;
}

static OstStatus begin(OstContext *ctx, const OstMesh *mesh, Part part, int cases, Extremes *extremes)
{
    OST_TRY(OST_NEW(ctx, &extremes->value, rows(mesh, part)));
    OST_TRY(OST_NEW(ctx, &extremes->governing, rows(mesh, part)));
    OST_TRY(OST_NEW(ctx, &extremes->share, cases));
    for (OstLocal i = 0; i < rows(mesh, part); i++)
        extremes->value[i] = part < FACTORS ? -INFINITY : OST_MOST_LOAD_FACTOR;
    return OST_SUCCESS;
}

OstStatus ost_envelope_create(const OstCase *c, const OstMesh *mesh, OstEnvelope **envelope)
{
    OstContext *ctx = mesh->ctx;
    int parts = FACTORS;
    for (int m = 0; m < c->material_count; m++)
        if (c->materials[m].material.strength.known)
            parts = PARTS;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, envelope, 1)));
    (*envelope)->ctx = ctx;
    (*envelope)->c = c;
    (*envelope)->mesh = mesh;
    OstStatus status = OST_SUCCESS;
    ost_ledger_enter(ctx, OST_LEDGER_OUTPUT);
    for (int p = 0; p < parts && status == OST_SUCCESS; p++)
        status = begin(ctx, mesh, (Part)p, c->load_case_count, &(*envelope)->of[p]);
    ost_ledger_leave(ctx);
    return ost_agree(ctx, status);
}

void ost_envelope_destroy(OstEnvelope **envelope)
{
    for (int p = 0; *envelope && p < PARTS; p++)
        OST_FREE((*envelope)->of[p].value, (*envelope)->of[p].governing, (*envelope)->of[p].share);
    OST_FREE(*envelope);
}

static OstStatus value_of(const OstResult *result, Part part, OstLocal i, double *value)
{
    const double *stress = result->stress + 6 * (size_t)i;
    if (part == DISPLACEMENT)
        *value = ost_norm3(result->displacement + 3 * (size_t)i);
    else if (part >= FACTORS)
        *value = ost_result_load_factor(result, i, (OstCriterion)(part - FACTORS), stress);
    else
        return ost_stress_measure(
            result, i, stress, part == VON_MISES ? OST_STRESS_MEASURE_VON_MISES : OST_STRESS_MEASURE_LARGEST_PRINCIPAL,
            value);
    return OST_SUCCESS;
}

static OstStatus take_part(const OstResult *result, Part part, int number, Extremes *extremes)
{
    for (OstLocal i = 0; extremes->value && i < rows(result->mesh, part); i++) {
        double value;
        OST_TRY(value_of(result, part, i, &value));
        if (!is_more(part, value, number + 1, extremes->value[i], extremes->governing[i]))
            continue;
        extremes->value[i] = value;
        extremes->governing[i] = number + 1;
    }
    return OST_SUCCESS;
}

OstStatus ost_envelope_take(OstEnvelope *envelope, int number, const OstResult *result)
{
    OstStatus status = OST_SUCCESS;
    ost_ledger_enter(envelope->ctx, OST_LEDGER_OUTPUT);
    for (int p = 0; p < PARTS && status == OST_SUCCESS; p++)
        status = take_part(result, (Part)p, number, &envelope->of[p]);
    ost_ledger_leave(envelope->ctx);
    envelope->taken++;
    return ost_agree(envelope->ctx, status);
}

void ost_envelope_file_name(const char *output, size_t size, char *path)
{
    size_t stem;
    ost_result_form(output, &stem);
    snprintf(path, size, "%.*s_envelope%s", (int)stem, output, output + stem);
}

/* Of the nodes and tets that this rank owns, then of all. */
static OstStatus conclude(const OstEnvelope *envelope, Part part, Extremes *extremes)
{
    OstContext *ctx = envelope->ctx;
    const int cases = envelope->c->load_case_count;
    const OstLocal owned = part == DISPLACEMENT ? envelope->mesh->owned_nodes : envelope->mesh->owned_tets;
    const double sign = part < FACTORS ? -1.0 : 1.0;
    double least = INFINITY, all = 0.0;
    OstGlobal by = cases;
    for (OstLocal i = 0; i < owned; i++)
        if (extremes->governing[i] > 0) {
            least = fmin(least, sign * extremes->value[i]);
            extremes->share[extremes->governing[i] - 1] += 1.0;
        }
    OST_TRY(ost_min(ctx, 1, &least));
    for (OstLocal i = 0; i < owned; i++)
        if (extremes->governing[i] > 0 && sign * extremes->value[i] == least && extremes->governing[i] <= by)
            by = extremes->governing[i] - 1;
    OST_TRY(ost_min_numbers(ctx, 1, &by));
    OST_TRY(ost_sum(ctx, cases, extremes->share));
    for (int k = 0; k < cases; k++)
        all += extremes->share[k];
    for (int k = 0; k < cases && all > 0.0; k++)
        extremes->share[k] /= all;
    extremes->most = sign * least;
    extremes->by = by < cases ? (int)by : -1;
    return OST_SUCCESS;
}

static OstStatus write_file(const OstEnvelope *envelope)
{
    OstOutputArray array[2 * PARTS];
    int count = 0;
    for (int p = 0; p < PARTS; p++) {
        const Extremes *extremes = &envelope->of[p];
        const OstCentring centring = p == DISPLACEMENT ? OST_ON_NODES : OST_ON_TETS;
        if (!extremes->value)
            continue;
        array[count++] = (OstOutputArray){about[p].field, centring, OST_VALUES_DOUBLE, 1, extremes->value};
        array[count++] = (OstOutputArray){about[p].governing, centring, OST_VALUES_INT32, 1, extremes->governing};
    }
    return ost_fields_write(envelope->mesh, envelope->file, count, array, NULL);
}

OstStatus ost_envelope_write(OstEnvelope *envelope, const char *output)
{
    OstStatus status = OST_SUCCESS;
    if (envelope->taken == 0)
        return OST_SUCCESS;
    ost_envelope_file_name(output, sizeof envelope->file, envelope->file);
    ost_ledger_enter(envelope->ctx, OST_LEDGER_OUTPUT);
    for (int p = 0; p < PARTS && status == OST_SUCCESS; p++)
        if (envelope->of[p].value)
            status = conclude(envelope, (Part)p, &envelope->of[p]);
    OST_THEN(write_file(envelope));
    ost_ledger_leave(envelope->ctx);
    return status;
}

/* --- what governs --- */

/* The cases that govern most, and how much. */
static void print_shares(const OstEnvelope *envelope, const Extremes *extremes)
{
    double before = 2.0, left = 1.0;
    int last = -1;
    for (int named = 0; named < MOST_NAMED; named++) {
        int next = -1;
        for (int k = 0; k < envelope->c->load_case_count; k++) {
            const double share = extremes->share[k];
            const int is_named = share > before || (share == before && k <= last);
            if (!is_named && share > 0.0 && (next < 0 || share > extremes->share[next]))
                next = k;
        }
        if (next < 0)
            return;
        printf("%s%s %.3g %%", named > 0 ? ", " : "", envelope->c->load_cases[next].name,
               100.0 * extremes->share[next]);
        before = extremes->share[last = next];
        left -= before;
    }
    if (left > 1e-9)
        printf(", others %.3g %%", 100.0 * left);
}

void ost_envelope_print(const OstEnvelope *envelope)
{
    if (ost_rank(envelope->ctx) != 0 || envelope->taken == 0)
        return;
    printf("  envelope of %d load case%s, written to %s\n", envelope->taken, envelope->taken == 1 ? "" : "s",
           envelope->file);
    for (int p = 0; p < PARTS; p++) {
        const Extremes *extremes = &envelope->of[p];
        if (!extremes->value)
            continue;
        printf("    %-23s", about[p].label);
        if (extremes->by < 0)
            fputs("nothing fails", stdout);
        else {
            printf("%.8g by %s; of the %s: ", extremes->most, envelope->c->load_cases[extremes->by].name,
                   p == DISPLACEMENT ? "nodes" : "tets");
            print_shares(envelope, extremes);
        }
        puts("");
    }
}

json_t *ost_envelope_json(const OstEnvelope *envelope)
{
    if (envelope->taken == 0)
        return NULL;
    json_t *fields = json_object();
    for (int p = 0; p < PARTS; p++) {
        const Extremes *extremes = &envelope->of[p];
        json_t *shares = json_object();
        for (int k = 0; extremes->value && k < envelope->c->load_case_count; k++)
            json_object_set_new(shares, envelope->c->load_cases[k].name, ost_json_number(extremes->share[k]));
        if (extremes->value)
            json_object_set_new(fields, about[p].field,
                                json_pack("{s:o, s:s?, s:O}", "value",
                                          extremes->by < 0 ? json_null() : ost_json_number(extremes->most), "load_case",
                                          extremes->by < 0 ? NULL : envelope->c->load_cases[extremes->by].name,
                                          "governs", shares));
        json_decref(shares);
    }
    return json_pack("{s:s, s:i, s:o}", "file", envelope->file, "load_cases", envelope->taken, "fields", fields);
}
