/* SPDX-License-Identifier: BSD-3-Clause */
#include "recovery/derived.h"

#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <string.h>

/* --- of one tensor --- */

double ost_von_mises(const double stress[6])
{
    double sum = 0.0;
    for (int i = 0; i < 3; i++) {
        const double difference = stress[i] - stress[(i + 1) % 3];
        sum += 0.5 * difference * difference + 3.0 * stress[3 + i] * stress[3 + i];
    }
    return sqrt(sum);
}

/* Of the two senses of a line, the one whose largest component is positive. */
static void point(const double line[3], double direction[3])
{
    int largest = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(line[i]) > fabs(line[largest]))
            largest = i;
    for (int i = 0; i < 3; i++)
        direction[i] = line[largest] < 0.0 ? -line[i] : line[i];
}

/* The eigenvalues, the largest first, and unit vectors along them (rows, unless NULL). */
static OstStatus find_principal(OstContext *ctx, const double tensor[6], double values[3], double *directions)
{
    const double full[9] = {tensor[0], tensor[3], tensor[5], tensor[3], tensor[1],
                            tensor[4], tensor[5], tensor[4], tensor[2]};
    double ascending[3], vectors[9];
    OST_TRY(ost_symmetric_eigen(ctx, 3, full, ascending, directions ? vectors : NULL));
    for (int k = 0; k < 3; k++) {
        values[k] = ascending[2 - k];
        if (directions)
            point(vectors + 3 * (2 - k), directions + 3 * k);
    }
    return OST_SUCCESS;
}

/* --- of one tet --- */

static void strain_of(const OstResult *result, OstLocal tet, double strain[6])
{
    for (int p = 0; p < 6; p++)
        strain[p] = (p < 3 ? 1.0 : 0.5) * result->strain[6 * (size_t)tet + (size_t)p];
}

/* Axes turn with the tet, where rotations are large. */
static void stress_along(const OstResult *result, OstLocal tet, const double before[9], const double stress[6],
                         double own[6])
{
    double axes[9];
    memcpy(axes, before, sizeof axes);
    for (int k = 0; result->rotation && k < 3; k++)
        ost_apply3(result->rotation + 9 * (size_t)tet, before + 3 * k, axes + 3 * k);
    ost_tensor_along(stress, axes, own);
}

void ost_result_material_stress(const OstResult *result, OstLocal tet, const double stress[6], double own[6])
{
    double axes[9];
    ost_field_axes(result->field, tet, axes);
    stress_along(result, tet, axes, stress, own);
}

void ost_result_material_stress_at(const OstResult *result, OstLocal tet, const double at[4], const double point[3],
                                   const double stress[6], double own[6])
{
    double axes[9];
    ost_field_axes_at(result->field, tet, at, point, axes);
    stress_along(result, tet, axes, stress, own);
}

OstStatus ost_stress_measure(const OstResult *result, OstLocal tet, const double stress[6], OstStressMeasure measure,
                             double *value)
{
    double several[6];
    if (measure <= OST_STRESS_MEASURE_ZX)
        *value = stress[measure];
    else if (measure <= OST_STRESS_MEASURE_31) {
        ost_result_material_stress(result, tet, stress, several);
        *value = several[measure - OST_STRESS_MEASURE_11];
    } else if (measure == OST_STRESS_MEASURE_VON_MISES)
        *value = ost_von_mises(stress);
    else if (measure == OST_STRESS_MEASURE_PRESSURE)
        *value = -(stress[0] + stress[1] + stress[2]) / 3.0;
    else {
        OST_TRY(find_principal(result->ctx, stress, several, NULL));
        *value = several[measure - OST_STRESS_MEASURE_LARGEST_PRINCIPAL];
    }
    return OST_SUCCESS;
}

static const OstStrength *strength_of(const OstResult *result, OstLocal tet)
{
    return &result->field->material[result->field->tet_region[tet]].strength;
}

double ost_result_load_factor(const OstResult *result, OstLocal tet, OstCriterion criterion, const double stress[6])
{
    double own[6];
    if (!strength_of(result, tet)->known)
        return OST_MOST_LOAD_FACTOR;
    ost_result_material_stress(result, tet, stress, own);
    return ost_load_factor(strength_of(result, tet), criterion, own);
}

static double load_factor(const OstResult *result, OstLocal tet, OstCriterion criterion)
{
    return ost_result_load_factor(result, tet, criterion, result->stress + 6 * (size_t)tet);
}

static OstStatus principal_direction(const OstResult *result, const double *stress, int which, double *value)
{
    double values[3], directions[9];
    OST_TRY(find_principal(result->ctx, stress, values, directions));
    memcpy(value, directions + 3 * which, 3 * sizeof *value);
    return OST_SUCCESS;
}

/* -tr(m) p / 3 at the centroid. */
static double mixed_pressure(const OstResult *result, OstLocal tet)
{
    const OstMaterialField *field = result->field;
    const double *p = result->pressure + 4 * (size_t)tet;
    const double *mode = ost_field_stiff_mode(field, field->tet_region[tet]);
    const double root = sqrt(ost_field_scale(field, tet, NULL));
    return mode ? -root * (mode[0] + mode[1] + mode[2]) / 3.0 * 0.25 * (p[0] + p[1] + p[2] + p[3]) : 0.0;
}

static OstStatus derive(const OstResult *result, OstLocal tet, OstOutputFieldBit field, double *value)
{
    const double *stress = result->stress ? result->stress + 6 * (size_t)tet : NULL;
    double strain[6], axes[9];
    switch (field) {
    case OST_FIELD_MATERIAL_STRESS:
        ost_result_material_stress(result, tet, stress, value);
        break;
    case OST_FIELD_MATERIAL_STRAIN:
        ost_field_axes(result->field, tet, axes);
        strain_of(result, tet, strain);
        ost_tensor_along(strain, axes, value);
        break;
    case OST_FIELD_VON_MISES:
        *value = ost_von_mises(stress);
        break;
    case OST_FIELD_PRESSURE:
        return ost_stress_measure(result, tet, stress, OST_STRESS_MEASURE_PRESSURE, value);
    case OST_FIELD_MIXED_PRESSURE:
        *value = mixed_pressure(result, tet);
        break;
    case OST_FIELD_PRINCIPAL_STRESS:
        return find_principal(result->ctx, stress, value, NULL);
    case OST_FIELD_PRINCIPAL_DIRECTION_1:
    case OST_FIELD_PRINCIPAL_DIRECTION_2:
    case OST_FIELD_PRINCIPAL_DIRECTION_3:
        return principal_direction(result, stress, (int)field - OST_FIELD_PRINCIPAL_DIRECTION_1, value);
    case OST_FIELD_PRINCIPAL_STRAIN:
        strain_of(result, tet, strain);
        return find_principal(result->ctx, strain, value, NULL);
    case OST_FIELD_E1:
    case OST_FIELD_E2:
    case OST_FIELD_E3:
        ost_field_axes(result->field, tet, axes);
        memcpy(value, axes + 3 * ((int)field - OST_FIELD_E1), 3 * sizeof *value);
        break;
    case OST_FIELD_TSAI_WU:
    case OST_FIELD_HILL:
    case OST_FIELD_MAXIMUM_STRESS:
        *value = load_factor(result, tet, (OstCriterion)(field - OST_FIELD_TSAI_WU));
        break;
    default:
        return OST_RAISE(result->ctx, OST_INVALID_INPUT, "'%s' is not made of other fields",
                         ost_output_field(field).word);
    }
    return OST_SUCCESS;
}

OstStatus ost_result_derive(const OstResult *result, OstOutputFieldBit field, double *values)
{
    const int components = ost_output_field(field).components;
    for (OstLocal tet = 0; tet < result->mesh->owned_tets; tet++, values += components)
        OST_TRY(derive(result, tet, field, values));
    return OST_SUCCESS;
}

/* --- of the body --- */

int ost_result_can_derive(const OstResult *result, OstOutputFieldBit field)
{
    const unsigned needs = ost_output_field(field).needs;
    const int has_stress = result->stress || !(needs >> OST_FIELD_STRESS & 1U);
    const int has_strain = result->strain || !(needs >> OST_FIELD_STRAIN & 1U);
    if (field >= OST_FIELD_TSAI_WU && field <= OST_FIELD_MAXIMUM_STRESS && !ost_field_has_strengths(result->field))
        return 0;
    if (field >= OST_FIELD_E1 && field <= OST_FIELD_E3)
        return result->field->region_axes || result->field->tet_turn;
    if (field == OST_FIELD_MIXED_PRESSURE)
        return result->pressure != NULL;
    return has_stress && has_strain;
}

void ost_tet_centre(const OstMesh *mesh, OstLocal tet, double place[3])
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    memset(place, 0, 3 * sizeof *place);
    for (int a = 0; a < 4; a++)
        for (int i = 0; i < 3; i++)
            place[i] += 0.25 * mesh->coordinates[3 * (size_t)nodes[a] + (size_t)i];
}

/* That of the rank with the lowest number. */
static OstStatus share_lowest(OstContext *ctx, OstGlobal tet, OstLeastFactor *least)
{
    OstGlobal lowest = tet;
    OST_TRY(ost_min_numbers(ctx, 1, &lowest));
    int holder = tet == lowest ? ost_rank(ctx) : -1;
    OST_TRY(ost_max_ints(ctx, 1, &holder));
    return OST_MPI(ctx, MPI_Bcast(least, sizeof *least, MPI_BYTE, holder, ost_comm(ctx)));
}

/* The least of a criterion over all ranks. Of tets that fail together but for rounding, the one with the lowest number
 * counts, whatever the number of ranks. */
static OstStatus find_least(const OstResult *result, OstCriterion criterion, OstLeastFactor *least)
{
    static const double alike = 1.0 + 1e-9;
    OstContext *ctx = result->ctx;
    const OstMesh *mesh = result->mesh;
    OstGlobal lowest = INT64_MAX;
    *least = (OstLeastFactor){.factor = OST_MOST_LOAD_FACTOR};
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++)
        least->factor = fmin(least->factor, load_factor(result, tet, criterion));
    OST_TRY(ost_min(ctx, 1, &least->factor));
    for (OstLocal tet = 0; tet < mesh->owned_tets && least->factor < OST_MOST_LOAD_FACTOR; tet++) {
        if (mesh->tet_label[tet] > lowest || load_factor(result, tet, criterion) > alike * least->factor)
            continue;
        lowest = least->tet = mesh->tet_label[tet];
        least->region = mesh->tet_region[tet];
        ost_tet_centre(mesh, tet, least->place);
    }
    return share_lowest(ctx, lowest, least);
}

OstStatus ost_result_find_failure(OstResult *result)
{
    result->failure.known = 1;
    for (int c = 0; c < OST_CRITERIA; c++)
        OST_TRY(find_least(result, (OstCriterion)c, &result->failure.least[c]));
    return OST_SUCCESS;
}
