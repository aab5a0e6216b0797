/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/command.h"
#include "cli/material_report.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/write_aside.h"
#include "orthostat/axes.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The ways to give a material; bits, so that an option can belong to several. */
enum { ISOTROPIC = 1, FAMILY = 2, NINE = 4, TRANSVERSE = 8, REGION = 16, ANY = ISOTROPIC | FAMILY | NINE | TRANSVERSE };

/* Groups of the help, in their order. */
enum { GROUP_FAMILY = 1, GROUP_NINE, GROUP_TRANSVERSE, GROUP_REPORT, GROUP_REGION };

/* Columns: name, word, argument, what it belongs to, group, help. */
#define OPTION_TABLE(X)                                                                                              \
    X(YOUNGS, "youngs", "E|E1,E2,E3", ISOTROPIC | FAMILY | NINE, GROUP_FAMILY, "Young's modulus, one or three")      \
    X(NU, "nu", "NU", ISOTROPIC | FAMILY | REGION, GROUP_FAMILY, "The one Poisson's ratio, -1 < NU < 0.5")           \
    X(SHEAR, "shear", "RULE", FAMILY, GROUP_FAMILY, "Mean E_ij for G_ij: geometric (default), arithmetic, min, max") \
    X(NU12, "nu12", "NU", NINE, GROUP_NINE, "Contraction along 2 when pulled along 1")                               \
    X(NU21, "nu21", "NU", NINE, GROUP_NINE, "... or along 1 when pulled along 2, and so on")                         \
    X(NU23, "nu23", "NU", NINE, GROUP_NINE, "")                                                                      \
    X(NU32, "nu32", "NU", NINE, GROUP_NINE, "")                                                                      \
    X(NU31, "nu31", "NU", NINE, GROUP_NINE, "")                                                                      \
    X(NU13, "nu13", "NU", NINE, GROUP_NINE, "")                                                                      \
    X(G12, "G12", "G", NINE, GROUP_NINE, "Shear modulus in the plane 1-2")                                           \
    X(G23, "G23", "G", NINE, GROUP_NINE, "")                                                                         \
    X(G31, "G31", "G", NINE, GROUP_NINE, "")                                                                         \
    X(PLANE_YOUNGS, "plane-youngs", "E", TRANSVERSE, GROUP_TRANSVERSE, "E1 = E2, along e1 and e2: the plane")        \
    X(AXIS_YOUNGS, "axis-youngs", "E", TRANSVERSE, GROUP_TRANSVERSE, "E3, along e3: the axis")                       \
    X(PLANE_NU, "plane-nu", "NU", TRANSVERSE, GROUP_TRANSVERSE, "nu12 within the plane")                             \
    X(PLANE_AXIS_NU, "plane-axis-nu", "NU", TRANSVERSE, GROUP_TRANSVERSE, "nu13 = nu23 (default: the family's)")     \
    X(AXIS_SHEAR, "axis-shear", "G", TRANSVERSE, GROUP_TRANSVERSE, "G23 = G31 (default: the family's)")              \
    X(AXES, "axes", "NINE", ANY, GROUP_REPORT, "Turn it: the axes e1, e2, e3 in world axes, nine numbers")           \
    X(ANGLE, "angle", "DEGREES", ANY, GROUP_REPORT, "... or an angle about e3")                                      \
    X(JSON, "json", 0, ANY, GROUP_REPORT, "Print JSON")                                                              \
    X(STABILITY_REGION, "stability-region", "FILE.csv", REGION, GROUP_REGION,                                        \
      "Write the boundary of the stable E1/E2, E3/E2 where nu12 = nu23 = nu31, for each of the list --nu")

#define OPTION_ENUM(name, word, argument, forms, group, help) OPTION_##name,
enum { OPTION_TABLE(OPTION_ENUM) OPTION_COUNT };
#undef OPTION_ENUM

/* Keys of argp above those that are letters; numbers of a list; points of a curve. */
enum { FIRST_KEY = 1000, MOST_NUMBERS = 32, POINTS = 360 };

static const struct {
    const char *word;
    unsigned forms;
} option_table[OPTION_COUNT] = {
#define OPTION_ROW(name, word, argument, forms, group, help) {word, forms},
    OPTION_TABLE(OPTION_ROW)
#undef OPTION_ROW
};

/* The text of each option given; NULL where not. */
typedef struct Request {
    OstContext *ctx;
    const char *text[OPTION_COUNT];
} Request;

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    Request *request = state->input;
    if (key == ARGP_KEY_ARG) {
        argp_error(state, "'%s' stands alone; every constant goes by its name, such as --nu12 0.3", value);
        return EINVAL;
    }
    if (key < FIRST_KEY || key >= FIRST_KEY + OPTION_COUNT)
        return ARGP_ERR_UNKNOWN;
    const int option = key - FIRST_KEY;
    if (request->text[option]) {
        argp_error(state, "--%s is given twice", option_table[option].word);
        return EINVAL;
    }
    request->text[option] = value ? value : "";
    return 0;
}

/* Numbers separated by commas or blanks; at least one, at most `most`. */
static OstStatus parse_numbers(const Request *request, int option, int most, double *numbers, int *count)
{
    const char *text = request->text[option];
    const char *rest = text;
    for (*count = 0; *count < most; (*count)++) {
        char *end = NULL;
        numbers[*count] = strtod(rest, &end);
        if (end == rest || !isfinite(numbers[*count]))
            break;
        rest = end + strspn(end, " ");
        if (*rest == '\0') {
            (*count)++;
            return OST_SUCCESS;
        }
        rest += *rest == ',';
    }
    return OST_RAISE(request->ctx, OST_INVALID_USAGE,
                     "--%s '%s': %d or fewer finite numbers, separated by commas, are expected",
                     option_table[option].word, text, most);
}

/* One number, or NAN if the option is not given. */
static OstStatus parse_number(const Request *request, int option, double *number)
{
    int count = 0;
    *number = NAN;
    return request->text[option] ? parse_numbers(request, option, 1, number, &count) : OST_SUCCESS;
}

static OstStatus require(const Request *request, int option, const char *form)
{
    if (request->text[option])
        return OST_SUCCESS;
    return OST_RAISE(request->ctx, OST_INVALID_USAGE, "--%s is missing, which %s needs", option_table[option].word,
                     form);
}

static OstStatus parse_shear_rule(const Request *request, OstShearRule *rule)
{
    static const char *const words[] = {"geometric", "arithmetic", "min", "max"};
    const char *text = request->text[OPTION_SHEAR];
    *rule = OST_SHEAR_GEOMETRIC;
    if (!text)
        return OST_SUCCESS;
    for (int i = 0; i < 4; i++)
        if (strcmp(text, words[i]) == 0) {
            *rule = (OstShearRule)i;
            return OST_SUCCESS;
        }
    return OST_RAISE(request->ctx, OST_INVALID_USAGE, "--shear '%s': geometric, arithmetic, min or max is expected",
                     text);
}

static OstStatus one_number_constants(const Request *request, int youngs_count, const double youngs[3],
                                      OstOrthotropic *constants)
{
    double nu = NAN;
    OstShearRule rule;
    OST_TRY(require(request, OPTION_NU, "a material of one Poisson's ratio"));
    OST_TRY(parse_number(request, OPTION_NU, &nu));
    OST_TRY(parse_shear_rule(request, &rule));
    *constants =
        youngs_count == 1 ? ost_orthotropic_isotropic(youngs[0], nu) : ost_orthotropic_family(youngs, nu, rule);
    return OST_SUCCESS;
}

static OstStatus nine_constants(const Request *request, int youngs_count, const double youngs[3],
                                OstOrthotropic *constants)
{
    double nu[6], shear[3];
    if (youngs_count != 3)
        return OST_RAISE(request->ctx, OST_INVALID_USAGE, "--youngs '%s': nine constants need three, E1,E2,E3",
                         request->text[OPTION_YOUNGS]);
    for (int i = 0; i < 6; i++)
        OST_TRY(parse_number(request, OPTION_NU12 + i, &nu[i]));
    for (int i = 0; i < 3; i++)
        OST_TRY(parse_number(request, OPTION_G12 + i, &shear[i]));
    return ost_orthotropic_named(request->ctx, "nine constants", youngs, nu, shear, constants);
}

static OstStatus transverse_constants(const Request *request, OstOrthotropic *constants)
{
    double value[5];
    for (int i = 0; i < 5; i++) {
        if (i < 3)
            OST_TRY(require(request, OPTION_PLANE_YOUNGS + i, "a transversely isotropic material"));
        OST_TRY(parse_number(request, OPTION_PLANE_YOUNGS + i, &value[i]));
    }
    *constants = ost_orthotropic_transverse(value[0], value[1], value[2], value[3], value[4]);
    return OST_SUCCESS;
}

static int any_given(const Request *request, int first, int last)
{
    for (int i = first; i <= last; i++)
        if (request->text[i])
            return 1;
    return 0;
}

static OstStatus refuse_options_outside(const Request *request, unsigned form, const char *form_name)
{
    for (int i = 0; i < OPTION_COUNT; i++)
        if (request->text[i] && !(option_table[i].forms & form))
            return OST_RAISE(request->ctx, OST_INVALID_USAGE, "--%s does not go with %s", option_table[i].word,
                             form_name);
    return OST_SUCCESS;
}

static OstStatus read_constants(const Request *request, OstOrthotropic *constants, const char **kind)
{
    double youngs[3] = {0};
    int count = 0;
    if (any_given(request, OPTION_PLANE_YOUNGS, OPTION_AXIS_SHEAR)) {
        *kind = "transversely isotropic";
        OST_TRY(refuse_options_outside(request, TRANSVERSE, "a transversely isotropic material"));
        return transverse_constants(request, constants);
    }
    OST_TRY(require(request, OPTION_YOUNGS, "a material"));
    OST_TRY(parse_numbers(request, OPTION_YOUNGS, 3, youngs, &count));
    if (count == 2)
        return OST_RAISE(request->ctx, OST_INVALID_USAGE, "--youngs '%s': one number or three are expected",
                         request->text[OPTION_YOUNGS]);
    *kind = count == 1 ? "isotropic" : "orthotropic";
    if (any_given(request, OPTION_NU12, OPTION_G31)) {
        OST_TRY(refuse_options_outside(request, NINE, "nine constants by name"));
        return nine_constants(request, count, youngs, constants);
    }
    OST_TRY(refuse_options_outside(request, count == 1 ? ISOTROPIC : FAMILY,
                                   count == 1 ? "an isotropic material" : "the stable family"));
    return one_number_constants(request, count, youngs, constants);
}

/* `given` tells whether axes or an angle are. */
static OstStatus read_axes(const Request *request, double axes[9], int *given)
{
    int count = 0;
    *given = request->text[OPTION_AXES] || request->text[OPTION_ANGLE];
    if (request->text[OPTION_AXES] && request->text[OPTION_ANGLE])
        return OST_RAISE(request->ctx, OST_INVALID_USAGE, "--axes and --angle are both given; give one of them");
    if (request->text[OPTION_ANGLE]) {
        double degrees[3] = {0};
        OST_TRY(parse_number(request, OPTION_ANGLE, &degrees[0]));
        return ost_axes_from_euler(request->ctx, "zxz", degrees, axes);
    }
    if (!*given)
        return OST_SUCCESS;
    OST_TRY(parse_numbers(request, OPTION_AXES, 9, axes, &count));
    if (count != 9)
        return OST_RAISE(request->ctx, OST_INVALID_USAGE,
                         "--axes has %d numbers; nine, e1 then e2 then e3, are expected", count);
    return ost_axes_check(request->ctx, "--axes", axes);
}

static OstStatus report_material(const Request *request)
{
    OstContext *ctx = request->ctx;
    OstOrthotropic constants;
    OstMaterial material;
    const char *kind = NULL;
    double axes[9];
    int turned = 0;
    const int json = request->text[OPTION_JSON] != NULL;
    OST_TRY(read_constants(request, &constants, &kind));
    OST_TRY(read_axes(request, axes, &turned));
    OST_TRY(ost_material_create(ctx, "as given", &constants, 0.0, &material));
    if (ost_rank(ctx) != 0 || (!json && ost_log_level(ctx) == OST_LOG_QUIET))
        return OST_SUCCESS;
    return ost_material_report(ctx, &material, material.isotropic ? "isotropic" : kind, turned ? axes : NULL, json);
}

/* --- the stability region of the naive choice --- */

typedef struct Curves {
    int count;
    const double *nu, *ratios;
} Curves;

static OstStatus write_curves(FILE *file, const void *content)
{
    const Curves *curves = content;
    fputs("nu,E1_over_E2,E3_over_E2\n", file);
    for (int k = 0; k < curves->count; k++)
        for (int i = 0; i <= POINTS; i++) { /* the last is the first: a closed curve */
            const double *point = curves->ratios + 2 * ((size_t)POINTS * (size_t)k + (size_t)(i % POINTS));
            fprintf(file, "%.12g,%.12g,%.12g\n", curves->nu[k], point[0], point[1]);
        }
    return OST_SUCCESS;
}

/* Rank 0's part of --stability-region: nu,E1_over_E2,E3_over_E2 of a closed curve for each nu. */
static OstStatus write_stability_region(const Request *request, const char *path)
{
    double nu[MOST_NUMBERS] = {0.1, 0.2, 0.3, 0.4, 0.45, 0.49};
    double *ratios = NULL;
    int count = 6;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(refuse_options_outside(request, REGION, "--stability-region"));
    if (request->text[OPTION_NU])
        OST_TRY_DONE(parse_numbers(request, OPTION_NU, MOST_NUMBERS, nu, &count));
    OST_TRY_DONE(OST_NEW(request->ctx, &ratios, 2 * POINTS * (size_t)count));
    for (int k = 0; k < count; k++)
        OST_TRY_DONE(ost_orthotropic_naive_boundary(request->ctx, nu[k], POINTS, ratios + 2 * POINTS * (size_t)k));
    status = ost_write_aside(request->ctx, path, write_curves, &(Curves){count, nu, ratios});
done:
    OST_FREE(ratios);
    return status;
}

static OstStatus run(OstContext *ctx, void *input)
{
    const Request *request = input;
    const char *path = request->text[OPTION_STABILITY_REGION];
    if (!path)
        return ost_agree(ctx, report_material(request));
    OST_TRY(ost_agree(ctx, ost_rank(ctx) == 0 ? write_stability_region(request, path) : OST_SUCCESS));
    ost_log(ctx, OST_LOG_NORMAL, "wrote %s; draw it with scripts/stability-region %s PICTURE.png", path, path);
    return OST_SUCCESS;
}

int ost_cli_material(OstContext *ctx, int argc, char **argv)
{
    static const struct argp_option options[] = {
        {0, 0, 0, 0, "Isotropic (one Young's modulus), or the stable family (three):", GROUP_FAMILY},
        {0, 0, 0, 0, "Nine constants, by name, with --youngs E1,E2,E3:", GROUP_NINE},
        {0, 0, 0, 0, "Transversely isotropic:", GROUP_TRANSVERSE},
        {0, 0, 0, 0, "Report:", GROUP_REPORT},
        {0, 0, 0, 0, "Stability region of the naive choice, in place of a material:", GROUP_REGION},
        {"poissons", FIRST_KEY + OPTION_NU, "NU", 0, "The same as --nu", GROUP_FAMILY},
#define OPTION_ARGP(name, word, argument, forms, group, help) \
    {word, FIRST_KEY + OPTION_##name, argument, 0, help, group},
        OPTION_TABLE(OPTION_ARGP)
#undef OPTION_ARGP
            {0},
    };
    const struct argp argp = {
        .options = options,
        .parser = parse_option,
        .doc = "Print a material's constants, stiffness, compliance, eigenvalues and stable range.",
    };
    Request request = {.ctx = ctx};
    return ost_cli_run(ctx, &argp, argc, argv, &request, run);
}
