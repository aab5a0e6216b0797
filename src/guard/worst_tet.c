/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/parallel/reduce.h"
#include "guard/guard.h"

#include <math.h>
#include <stdio.h>

/* A tet of lower quality may be why rounding hides the answer: its edges and heights differ a hundredfold. */
static const double plausible = 1e-2;

typedef struct WorstTet {
    double quality;
    OstLocal tet;
} WorstTet;

static WorstTet find_worst(const OstMesh *mesh)
{
    WorstTet worst = {INFINITY, -1};
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++) {
        const double quality = ost_tet_quality(mesh->coordinates, ost_mesh_nodes_of(mesh, tet));
        if (quality < worst.quality ||
            (quality == worst.quality && mesh->tet_label[tet] < ost_mesh_tet_number(mesh, worst.tet)))
            worst = (WorstTet){quality, tet};
    }
    return worst;
}

OstStatus ost_guard_worst_tet(const OstMesh *mesh, char words[OST_WORST_TET_SIZE])
{
    const WorstTet worst = find_worst(mesh);
    double quality = worst.quality, middle[3] = {0.0};
    words[0] = '\0';
    OST_TRY(ost_min(mesh->ctx, 1, &quality));
    if (!(quality < plausible))
        return OST_SUCCESS;
    const int has_it = worst.tet >= 0 && worst.quality == quality;
    OstGlobal label = has_it ? ost_mesh_tet_number(mesh, worst.tet) : INT64_MAX;
    OST_TRY(ost_min_numbers(mesh->ctx, 1, &label));
    if (has_it && ost_mesh_tet_number(mesh, worst.tet) == label)
        for (int i = 0; i < 12; i++) {
            const size_t vertex = (size_t)ost_mesh_nodes_of(mesh, worst.tet)[i / 3];
            middle[i % 3] += 0.25 * mesh->coordinates[3 * vertex + (size_t)(i % 3)];
        }
    OST_TRY(ost_sum(mesh->ctx, 3, middle));
    snprintf(
        words, OST_WORST_TET_SIZE,
        "the worst tet, %lld around (%.6g, %.6g, %.6g), has a quality of %.2g (1: regular, 0: flat) and may be the "
        "cause: mend the mesh there",
        (long long)label, middle[0], middle[1], middle[2], quality);
    return OST_SUCCESS;
}

OstStatus ost_guard_explain(const OstProblem *problem, OstStatus status)
{
    char words[OST_WORST_TET_SIZE], text[OST_ERROR_TEXT_SIZE];
    if (status != OST_NOT_CONVERGED)
        return status;
    snprintf(text, sizeof text, "%s", ost_error_text(problem->ctx));
    OST_TRY(ost_guard_worst_tet(problem->mesh, words));
    return OST_RAISE(problem->ctx, status, "%s%s%s", text, words[0] ? "; " : "", words);
}
