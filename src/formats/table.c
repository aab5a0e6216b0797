/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/serial/formats.h"
#include "formats/serial/line_reader.h"

#include <inttypes.h>
#include <string.h>

enum { PIECE_ROWS = 16384, TABLE_TAG = 701 };

/* The table on rank 0, and the buffers of one request. */
typedef struct Table {
    int width;
    OstGlobal lines;
    double *row;
    OstGlobal *wanted; /* PIECE_ROWS */
    double *piece;     /* PIECE_ROWS × width */
} Table;

static OstStatus read_row(OstLineReader *reader, const Table *table, OstGlobal number)
{
    char what[64];
    for (int i = 0; i < table->width; i++) {
        snprintf(what, sizeof what, "number %d of %d", i + 1, table->width);
        OST_TRY(ost_lines_number(reader, what, &table->row[number * table->width + i]));
    }
    snprintf(what, sizeof what, "%d numbers", table->width);
    return ost_lines_finish(reader, what);
}

static OstStatus read_rows(OstLineReader *reader, Table *table)
{
    const OstGlobal possible = reader->bytes / (2 * table->width) + 1;
    const OstGlobal room = possible < table->lines ? possible : table->lines;
    OstGlobal number = 0;
    int found = 0;
    OST_TRY(OST_NEW(reader->ctx, &table->row, room * table->width));
    OST_TRY(ost_lines_next(reader, &found));
    for (; found && number < room; number++) {
        OST_TRY(read_row(reader, table, number));
        OST_TRY(ost_lines_next(reader, &found));
    }
    if (found)
        return OST_RAISE_LINE(reader, "more lines of %d numbers than the %" PRId64 " expected", table->width,
                              table->lines);
    if (number < table->lines)
        return OST_RAISE_LINE(reader, "the file ends after %" PRId64 " lines of %d numbers, expected %" PRId64, number,
                              table->width, table->lines);
    return OST_SUCCESS;
}

static OstStatus read_table(OstContext *ctx, const char *path, Table *table)
{
    OstLineReader reader;
    OST_TRY(ost_lines_open(ctx, path, &reader));
    const OstStatus status = read_rows(&reader, table);
    ost_lines_close(&reader);
    return status;
}

static void copy_rows(const Table *table, OstLocal count, const OstGlobal *labels, double *values)
{
    const size_t width = (size_t)table->width;
    for (OstLocal i = 0; i < count; i++)
        memcpy(values + (size_t)i * width, table->row + (size_t)(labels[i] - 1) * width, width * sizeof *values);
}

static OstLocal piece_length(OstLocal count, OstLocal done)
{
    return count - done < PIECE_ROWS ? count - done : PIECE_ROWS;
}

/* Rank 0 answers one rank's requests. */
static OstStatus serve(OstContext *ctx, const Table *table, int rank, OstLocal count)
{
    for (OstLocal done = 0; done < count; done += PIECE_ROWS) {
        const OstLocal length = piece_length(count, done);
        OST_TRY(OST_MPI(
            ctx, MPI_Recv(table->wanted, length, MPI_INT64_T, rank, TABLE_TAG, ost_comm(ctx), MPI_STATUS_IGNORE)));
        copy_rows(table, length, table->wanted, table->piece);
        OST_TRY(
            OST_MPI(ctx, MPI_Send(table->piece, length * table->width, MPI_DOUBLE, rank, TABLE_TAG, ost_comm(ctx))));
    }
    return OST_SUCCESS;
}

static OstStatus ask(OstContext *ctx, const Table *table, OstLocal count, const OstGlobal *labels, double *values)
{
    for (OstLocal done = 0; done < count; done += PIECE_ROWS) {
        const OstLocal length = piece_length(count, done);
        OST_TRY(OST_MPI(ctx, MPI_Send(labels + done, length, MPI_INT64_T, 0, TABLE_TAG, ost_comm(ctx))));
        OST_TRY(OST_MPI(ctx, MPI_Recv(values + (size_t)done * (size_t)table->width, length * table->width, MPI_DOUBLE,
                                      0, TABLE_TAG, ost_comm(ctx), MPI_STATUS_IGNORE)));
    }
    return OST_SUCCESS;
}

static OstStatus hand_out(OstContext *ctx, const Table *table, OstLocal count, const OstGlobal *labels, double *values)
{
    MPI_Comm comm = ost_comm(ctx);
    if (ost_rank(ctx) != 0) {
        OST_TRY(OST_MPI(ctx, MPI_Send(&count, 1, MPI_INT32_T, 0, TABLE_TAG, comm)));
        return ask(ctx, table, count, labels, values);
    }
    copy_rows(table, count, labels, values);
    for (int rank = 1; rank < ost_size(ctx); rank++) {
        OstLocal wanted = 0;
        OST_TRY(OST_MPI(ctx, MPI_Recv(&wanted, 1, MPI_INT32_T, rank, TABLE_TAG, comm, MPI_STATUS_IGNORE)));
        OST_TRY(serve(ctx, table, rank, wanted));
    }
    return OST_SUCCESS;
}

static OstStatus check_labels(OstContext *ctx, const char *path, OstGlobal lines, OstLocal count,
                              const OstGlobal *labels)
{
    for (OstLocal i = 0; i < count; i++)
        if (labels[i] < 1 || labels[i] > lines)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: line %" PRId64 " asked for, expected 1 to %" PRId64, path,
                             labels[i], lines);
    return OST_SUCCESS;
}

OstStatus ost_table_read(OstContext *ctx, const char *path, int width, OstGlobal lines, OstLocal count,
                         const OstGlobal *labels, double *values)
{
    Table table = {.width = width, .lines = lines};
    OstStatus status = check_labels(ctx, path, lines, count, labels);
    if (status == OST_SUCCESS && ost_rank(ctx) == 0) {
        const size_t room = ost_size(ctx) > 1 ? PIECE_ROWS : 0; /* a single rank gets no requests */
        status = OST_NEW(ctx, &table.wanted, room);
        OST_THEN(OST_NEW(ctx, &table.piece, room * (size_t)width));
        OST_THEN(read_table(ctx, path, &table));
    }
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(hand_out(ctx, &table, count, labels, values));
done:
    OST_FREE(table.row, table.wanted, table.piece);
    return status;
}
