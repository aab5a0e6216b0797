/* SPDX-License-Identifier: BSD-3-Clause */
#include "guard/freedom_report.h"

#include "core/error.h"
#include "core/small.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* A number below this share of its neighbours is a rounding error, and printed as 0. */
static const double nothing = 1e-9;

enum { POINT_TEXT = 96 };

/* Components no larger than `least` are 0. */
static void number_words(const double point[3], double least, int digits, char text[POINT_TEXT])
{
    double x[3];
    for (int i = 0; i < 3; i++) {
        /* slightly outwards: a number midway between two of six digits is printed alike after any rounding */
        x[i] = fabs(point[i]) <= least ? 0.0 : point[i] * (1.0 + nothing);
    }
    snprintf(text, POINT_TEXT, "(%.*g, %.*g, %.*g)", digits, x[0], digits, x[1], digits, x[2]);
}

void ost_point_words(const double point[3], double scale, char text[96])
{
    number_words(point, nothing * scale, 6, text);
}

/* Motions known to 1e-6 are told with six digits, rough ones with three. */
static int digits_of(double same)
{
    return same > 1e-3 ? 3 : 6;
}

/* A direction's text, with its first component positive. */
static void direction_words(const double direction[3], double same, char text[POINT_TEXT])
{
    double d[3];
    const double length = ost_norm3(direction);
    int first = 0;
    while (first < 2 && fabs(direction[first]) <= same * length)
        first++;
    const double sign = direction[first] < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < 3; i++)
        d[i] = fabs(direction[i]) <= same * length ? 0.0 : sign * direction[i] / length;
    number_words(d, nothing, digits_of(same), text);
}

typedef struct Words {
    char *text;
    size_t size, used;
    int clauses;
} Words;

static void say(Words *words, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void say(Words *words, const char *format, ...)
{
    va_list arguments;
    if (words->used >= words->size)
        return;
    va_start(arguments, format);
    const int length = vsnprintf(words->text + words->used, words->size - words->used, format, arguments);
    va_end(arguments);
    words->used += length > 0 ? (size_t)length : 0;
}

static void next_clause(Words *words)
{
    say(words, "%s", words->clauses++ > 0 ? ", and " : "can ");
}

/* The motions as pure translations, and rotations each with the translation that goes with it. */
typedef struct Sorted {
    double same; /* motions that differ by less than this share of the body's size are the same */
    int moves, turns;
    double move[9]; /* rows: orthonormal translations */
    double turn[9]; /* rows: rotation vectors of length 1 */
    double with[9]; /* rows: the velocity of the centre that goes with each, orthogonal to the translations */
} Sorted;

/* Subtracts from v its projection on the orthonormal rows. */
static void subtract_projection(int count, const double *rows, double v[3])
{
    for (int pass = 0; pass < 2; pass++)
        for (int r = 0; r < count; r++) {
            const double component = ost_dot3(v, rows + 3 * r);
            for (int i = 0; i < 3; i++)
                v[i] -= component * rows[3 * r + i];
        }
}

/* Reduced row echelon form of `count` motions with independent rotations, by their rotations: the words then do not
 * depend on the basis that was found. */
static void reduce_rotations(double same, int count, double *motion)
{
    int row = 0;
    for (int column = 3; column < 6 && row < count; column++) {
        int best = row;
        for (int r = row + 1; r < count; r++)
            if (fabs(motion[6 * r + column]) > fabs(motion[6 * best + column]))
                best = r;
        if (fabs(motion[6 * best + column]) <= same)
            continue;
        for (int k = 0; k < 6; k++) {
            const double swapped = motion[6 * row + k];
            motion[6 * row + k] = motion[6 * best + k];
            motion[6 * best + k] = swapped;
        }
        const double pivot = motion[6 * row + column];
        for (int k = 0; k < 6; k++)
            motion[6 * row + k] /= pivot;
        for (int r = 0; r < count; r++) {
            const double factor = motion[6 * r + column];
            for (int k = 0; r != row && k < 6; k++)
                motion[6 * r + k] -= factor * motion[6 * row + k];
        }
        row++;
    }
}

/* An orthonormal basis in which rotations come first, by the singular vectors of the rotations alone. */
static OstStatus sort_motions(OstContext *ctx, int count, const double *motions, Sorted *sorted)
{
    double rotations[18], basis[36], motion[36] = {0.0};
    for (int j = 0; j < 3; j++)
        for (int m = 0; m < count; m++)
            rotations[j * count + m] = motions[6 * m + 3 + j];
    OST_TRY(ost_null_space(ctx, 3, count, rotations, sorted->same, &sorted->moves, basis));
    if (sorted->moves > 3)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "%d rigid motions are not independent", count);
    sorted->turns = count - sorted->moves;
    for (int m = 0; m < sorted->moves; m++) {
        double *move = sorted->move + 3 * m;
        memset(move, 0, 3 * sizeof *move);
        for (int k = 0; k < count; k++)
            for (int i = 0; i < 3; i++)
                move[i] += basis[m * count + k] * motions[6 * k + i];
        subtract_projection(m, sorted->move, move);
        const double length = ost_norm3(move);
        for (int i = 0; i < 3; i++)
            move[i] /= length;
    }
    /* The rotations: the complement of the translations among the coefficients. */
    double span[36];
    int turns = 0;
    memcpy(span, basis, (size_t)(sorted->moves * count) * sizeof *span);
    double complement[36];
    OST_TRY(ost_null_space(ctx, sorted->moves, count, span, 0.5, &turns, complement));
    for (int m = 0; m < turns; m++)
        for (int k = 0; k < count; k++)
            for (int i = 0; i < 6; i++)
                motion[6 * m + i] += complement[m * count + k] * motions[6 * k + i];
    reduce_rotations(sorted->same, turns, motion);
    for (int m = 0; m < turns; m++) {
        const double length = ost_norm3(motion + 6 * m + 3);
        for (int i = 0; i < 3; i++) {
            sorted->with[3 * m + i] = motion[6 * m + i] / length;
            sorted->turn[3 * m + i] = motion[6 * m + 3 + i] / length;
        }
        subtract_projection(sorted->moves, sorted->move, sorted->with + 3 * m);
    }
    return OST_SUCCESS;
}

static void say_moves(Words *words, const Sorted *sorted)
{
    char text[POINT_TEXT];
    double normal[3];
    if (sorted->moves == 0)
        return;
    next_clause(words);
    if (sorted->moves == 3) {
        say(words, "move in any direction");
    } else if (sorted->moves == 2) {
        ost_cross3(sorted->move, sorted->move + 3, normal);
        direction_words(normal, sorted->same, text);
        say(words, "move in any direction normal to %s", text);
    } else {
        direction_words(sorted->move, sorted->same, text);
        say(words, "move along %s", text);
    }
}

/* Is there a point that all rotations leave at rest (up to `nothing`)? Solves v_i = q × w_i for q, in the least squares
 * sense. */
static int find_pivot(const Sorted *sorted, double pivot[3])
{
    double normal[9] = {0.0}, right[3] = {0.0}, inverse[9];
    for (int t = 0; t < sorted->turns; t++) {
        const double *w = sorted->turn + 3 * t;
        double vw[3];
        ost_cross3(w, sorted->with + 3 * t, vw); /* (q × w) seen from w: w × (q × w) = q - w (w·q) */
        for (int i = 0; i < 3; i++) {
            right[i] += vw[i];
            for (int j = 0; j < 3; j++)
                normal[3 * i + j] += (i == j ? 1.0 : 0.0) - w[i] * w[j];
        }
    }
    if (fabs(ost_invert3(normal, inverse)) < sorted->same)
        return 0;
    ost_apply3(inverse, right, pivot);
    for (int t = 0; t < sorted->turns; t++) {
        double v[3];
        ost_cross3(pivot, sorted->turn + 3 * t, v);
        for (int i = 0; i < 3; i++)
            if (fabs(v[i] - sorted->with[3 * t + i]) > sorted->same * (1.0 + ost_norm3(pivot)))
                return 0;
    }
    return 1;
}

static void place_words(const OstRigidFrame *frame, const Sorted *sorted, const double at[3], char text[POINT_TEXT])
{
    double x[3], scale = frame->radius;
    for (int i = 0; i < 3; i++) {
        x[i] = frame->centre[i] + frame->radius * at[i];
        scale = fmax(scale, fabs(x[i]));
    }
    number_words(x, (sorted->same > 1e-3 ? sorted->same : nothing) * scale, digits_of(sorted->same), text);
}

/* Subtracts translations so that as little motion along the axis remains as possible: a screw becomes a rotation if the
 * body can slide along the axis. */
static void remove_advance(const Sorted *sorted, const double w[3], double v[3])
{
    double across[3] = {w[0], w[1], w[2]};
    subtract_projection(sorted->moves, sorted->move, across);
    double within[3] = {w[0] - across[0], w[1] - across[1], w[2] - across[2]};
    const double component = ost_dot3(within, w);
    if (component <= sorted->same)
        return;
    const double factor = ost_dot3(v, w) / component;
    for (int i = 0; i < 3; i++)
        v[i] -= factor * within[i];
}

/* Can the body translate in every direction normal to the axis? Then the axis may pass anywhere. */
static int slides_across(const Sorted *sorted, const double w[3])
{
    if (sorted->moves == 3)
        return 1;
    if (sorted->moves < 2)
        return 0;
    double normal[3], cross[3];
    ost_cross3(sorted->move, sorted->move + 3, normal);
    ost_cross3(normal, w, cross);
    return ost_norm3(cross) <= sorted->same;
}

static void say_turn(Words *words, const OstRigidFrame *frame, const Sorted *sorted, int t)
{
    const double *w = sorted->turn + 3 * t;
    double v[3], at[3];
    char axis[POINT_TEXT], place[POINT_TEXT];
    memcpy(v, sorted->with + 3 * t, sizeof v);
    remove_advance(sorted, w, v);
    const double advance = ost_dot3(v, w);
    ost_cross3(w, v, at);
    direction_words(w, sorted->same, axis);
    place_words(frame, sorted, at, place);
    next_clause(words);
    if (slides_across(sorted, w))
        say(words, "turn about any line along %s", axis);
    else if (fabs(advance) <= sorted->same * (1.0 + ost_norm3(v)))
        say(words, "turn about the line through %s along %s", place, axis);
    else
        say(words, "twist about the line through %s along %s, moving %.6g along it per turn", place, axis,
            2.0 * M_PI * advance * frame->radius * (1.0 + nothing));
}

static void say_turns(Words *words, const OstRigidFrame *frame, const Sorted *sorted)
{
    double pivot[3], normal[3];
    char place[POINT_TEXT], axis[POINT_TEXT];
    if (sorted->turns == 3 && sorted->moves == 3) {
        next_clause(words);
        say(words, "turn about any axis");
    } else if (sorted->turns >= 2 && sorted->moves == 0 && find_pivot(sorted, pivot)) {
        place_words(frame, sorted, pivot, place);
        next_clause(words);
        say(words, "turn about any line through %s", place);
        if (sorted->turns == 2) {
            ost_cross3(sorted->turn, sorted->turn + 3, normal);
            direction_words(normal, sorted->same, axis);
            say(words, " normal to %s", axis);
        }
    } else {
        for (int t = 0; t < sorted->turns; t++)
            say_turn(words, frame, sorted, t);
    }
}

OstStatus ost_motion_words(OstContext *ctx, const OstRigidFrame *frame, int count, const double *motions, double same,
                           char *text, size_t size)
{
    Sorted sorted = {.same = same};
    Words words = {text, size, 0, 0};
    OST_TRY(sort_motions(ctx, count, motions, &sorted));
    text[0] = 0;
    say_moves(&words, &sorted);
    say_turns(&words, frame, &sorted);
    return OST_SUCCESS;
}
