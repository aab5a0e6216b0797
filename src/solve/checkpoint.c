/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/hash.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "core/parallel/reduce.h"
#include "core/write_aside.h"
#include "problem/problem.h"
#include "solve/path_data.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

/* The file: a header, the steps done, what the answers are made of (of arrays, that of each rank in turn), and the hash
 * of all that. In the byte order of the machine: only the program that wrote it, on such a machine, takes the same bits
 * from it. */
typedef struct Header {
    char magic[16];
    int32_t version, ranks;
    uint64_t case_hash;    /* of the text; 0 without a case */
    uint64_t problem_hash; /* of mesh, partition, materials, loads, supports and times */
    int32_t count, done;
    int32_t parts;     /* of linear answers; 0 if the steps are Newton's */
    int32_t nonlinear; /* then the state's displacement and slope follow */
    double t, step;
} Header;

enum { VERSION = 1, BLOCK = 65536 };
static const char magic[16] = "orthostat path";

static uint64_t hash_supports(uint64_t hash, const OstSupports *supports)
{
    for (OstLocal s = 0; s < supports->count; s++) {
        const OstSupport *support = &supports->support[s];
        hash = ost_hash(hash, 3 * (size_t)support->constrained * sizeof(double), support->direction);
        hash = ost_hash(hash, (size_t)support->constrained * sizeof(double), support->prescribed);
    }
    return ost_hash(hash, (size_t)supports->mesh->node_count * sizeof(OstLocal), supports->index);
}

static uint64_t hash_table(uint64_t hash, const OstTimeTable *table)
{
    hash = ost_hash(hash, (size_t)table->count * sizeof(double), table->time);
    return ost_hash(hash, (size_t)table->count * sizeof(double), table->factor);
}

static uint64_t hash_field(uint64_t hash, const OstMaterialField *field, OstLocal tets)
{
    for (int r = 0; r < field->region_count; r++)
        hash = ost_hash(hash, sizeof(OstOrthotropic), &field->material[r].constants);
    if (field->region_axes)
        hash = ost_hash(hash, 9 * (size_t)field->region_count * sizeof(double), field->region_axes);
    return field->tet_axes ? ost_hash(hash, 9 * (size_t)tets * sizeof(double), field->tet_axes) : hash;
}

/* What this rank knows of the problem and the path. */
static uint64_t hash_here(const OstPath *path)
{
    const OstProblem *problem = path->problem;
    const OstMesh *mesh = problem->mesh;
    const size_t loads = 3 * (size_t)mesh->owned_nodes * sizeof(double);
    const size_t corners = (size_t)mesh->tet_count * (size_t)mesh->nodes_per_tet;
    uint64_t hash = ost_hash(OST_HASH_START, (size_t)path->count * sizeof(double), path->times);
    hash = ost_hash(hash, 3 * (size_t)mesh->node_count * sizeof(double), mesh->coordinates);
    hash = ost_hash(hash, (size_t)mesh->node_count * sizeof(OstGlobal), mesh->node_label);
    hash = ost_hash(hash, corners * sizeof(OstLocal), mesh->tet_nodes);
    hash = ost_hash(hash, (size_t)mesh->tet_count * sizeof(int32_t), mesh->tet_region);
    hash = hash_field(hash, problem->field, mesh->tet_count);
    hash = hash_supports(ost_hash(hash, loads, problem->force), problem->supports);
    for (int k = 0; k < problem->timed_count; k++) {
        hash = hash_table(hash, &problem->timed[k].table);
        hash = hash_supports(ost_hash(hash, loads, problem->timed[k].force), problem->timed[k].supports);
    }
    return hash;
}

static OstStatus describe(const OstPath *path, Header *header)
{
    const uint64_t here = hash_here(path);
    uint64_t *all = NULL;
    OstLocal total = 0;
    *header = (Header){.version = VERSION,
                       .ranks = ost_size(path->ctx),
                       .case_hash = path->problem->c ? path->problem->c->text_hash : 0,
                       .count = path->count,
                       .done = path->done,
                       .parts = path->nonlinear ? 0 : path->linear.count,
                       .nonlinear = path->nonlinear,
                       .t = path->state.t,
                       .step = path->state.step};
    memcpy(header->magic, magic, sizeof magic);
    OST_TRY(ost_gather_items(path->ctx, sizeof here, &here, 1, "there are too many ranks", (void **)&all, &total));
    header->problem_hash = ost_hash(OST_HASH_START, (size_t)total * sizeof *all, all);
    OST_FREE(all);
    return OST_SUCCESS;
}

/* --- writing: rank 0 writes, and takes the others' arrays in turn --- */

typedef struct Writer {
    FILE *file;
    uint64_t hash;
    int failed; /* errno of the first failure; what else would be written is still taken */
} Writer;

static void put(Writer *writer, size_t size, const void *bytes)
{
    errno = 0;
    if (!writer->failed && fwrite(bytes, 1, size, writer->file) != size)
        writer->failed = errno ? errno : EIO;
    writer->hash = ost_hash(writer->hash, size, bytes);
}

/* The most numbers that a rank has in an array. */
static OstStatus find_largest(const OstPath *path, OstGlobal *largest)
{
    *largest = 3 * (OstGlobal)path->problem->mesh->node_count;
    return ost_max_numbers(path->ctx, 1, largest);
}

/* An array of all ranks; `room` (rank 0) takes the largest. */
static OstStatus put_array(OstContext *ctx, Writer *writer, OstGlobal count, const double *values, double *room)
{
    const MPI_Comm comm = ost_comm(ctx);
    if (ost_rank(ctx) != 0) {
        OST_TRY(OST_MPI(ctx, MPI_Send(&count, 1, MPI_INT64_T, 0, 0, comm)));
        return OST_MPI(ctx, MPI_Send(values, (int)count, MPI_DOUBLE, 0, 1, comm));
    }
    put(writer, sizeof count, &count);
    put(writer, (size_t)count * sizeof *values, values);
    for (int rank = 1; rank < ost_size(ctx); rank++) {
        OstGlobal theirs = 0;
        OST_TRY(OST_MPI(ctx, MPI_Recv(&theirs, 1, MPI_INT64_T, rank, 0, comm, MPI_STATUS_IGNORE)));
        OST_TRY(OST_MPI(ctx, MPI_Recv(room, (int)theirs, MPI_DOUBLE, rank, 1, comm, MPI_STATUS_IGNORE)));
        put(writer, sizeof theirs, &theirs);
        put(writer, (size_t)theirs * sizeof *room, room);
    }
    return OST_SUCCESS;
}

/* What the next step is made from: the parts of linear answers, or the state of Newton's method. */
static OstStatus put_arrays(const OstPath *path, Writer *writer)
{
    OstContext *ctx = path->ctx;
    const OstSuperposition *linear = &path->linear;
    const OstGlobal count = 3 * (OstGlobal)path->problem->mesh->node_count;
    OstGlobal largest = 0;
    double *room = NULL;
    OST_TRY(find_largest(path, &largest));
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &room, ost_rank(ctx) == 0 ? largest : 0)));
    OstStatus status = OST_SUCCESS;
    for (int k = 0; k < linear->count && !path->nonlinear; k++)
        OST_THEN(put_array(ctx, writer, count, linear->part[k], room));
    if (path->nonlinear) {
        status = put_array(ctx, writer, count, path->state.displacement, room);
        OST_THEN(put_array(ctx, writer, count, path->state.slope, room));
    }
    OST_FREE(room);
    return status;
}

/* The rest that is the same on all ranks. */
static void put_reports(const OstPath *path, Writer *writer)
{
    const OstSuperposition *linear = &path->linear;
    put(writer, (size_t)path->done * sizeof *path->steps, path->steps);
    put(writer, sizeof path->judged, &path->judged);
    put(writer, sizeof linear->solve, &linear->solve);
    if (!path->nonlinear)
        put(writer, (size_t)linear->count * sizeof *linear->norm, linear->norm);
}

static OstStatus open_writer(OstContext *ctx, const OstAside *aside, Writer *writer)
{
    *writer = (Writer){.hash = OST_HASH_START};
    if (ost_rank(ctx) != 0)
        return OST_SUCCESS;
    writer->file = fopen(aside->aside, "wb");
    return writer->file
               ? OST_SUCCESS
               : OST_RAISE(ctx, OST_FILE_FAILED, "cannot write the checkpoint '%s': %s", aside->path, strerror(errno));
}

static OstStatus close_writer(OstContext *ctx, const OstAside *aside, Writer *writer)
{
    const uint64_t hash = writer->hash;
    if (ost_rank(ctx) != 0)
        return OST_SUCCESS;
    put(writer, sizeof hash, &hash);
    if (fclose(writer->file) != 0 && !writer->failed)
        writer->failed = errno ? errno : EIO;
    return writer->failed ? OST_RAISE(ctx, OST_FILE_FAILED, "cannot write the checkpoint '%s': %s", aside->path,
                                      strerror(writer->failed))
                          : OST_SUCCESS;
}

static OstStatus write_file(const OstPath *path, const OstAside *aside)
{
    OstContext *ctx = path->ctx;
    Header header;
    Writer writer;
    OST_TRY(describe(path, &header));
    OST_TRY(ost_agree(ctx, open_writer(ctx, aside, &writer)));
    if (ost_rank(ctx) == 0) {
        put(&writer, sizeof header, &header);
        put_reports(path, &writer);
    }
    const OstStatus status = put_arrays(path, &writer);
    const OstStatus closed = close_writer(ctx, aside, &writer);
    return ost_agree(ctx, status == OST_SUCCESS ? closed : status);
}

OstStatus ost_path_save(const OstPath *path, const char *file)
{
    OstContext *ctx = path->ctx;
    OstAside aside = {0};
    ost_ledger_enter(ctx, OST_EFFECT_PATH);
    OstStatus status = ost_aside_open_together(ctx, file, &aside);
    OST_THEN(ost_aside_finish_together(ctx, &aside, write_file(path, &aside)));
    ost_ledger_leave(ctx);
    return status;
}

/* --- reading --- */

static OstStatus raise_damaged(OstContext *ctx, const char *name, const char *what)
{
    return OST_RAISE(ctx, OST_INVALID_INPUT,
                     "%s: this checkpoint cannot be used: %s; delete it, or leave out --resume, to begin the path anew",
                     name, what);
}

/* Is the file whole, byte by byte? */
static OstStatus check_whole(OstContext *ctx, const char *name, FILE *file)
{
    char *bytes = NULL;
    uint64_t hash = OST_HASH_START, stated = 0;
    size_t size = 0, got = 0;
    OST_TRY(OST_NEW(ctx, &bytes, BLOCK + sizeof hash));
    while ((got = fread(bytes + size, 1, BLOCK + sizeof hash - size, file)) > 0) {
        size += got;
        if (size > sizeof hash) { /* the last bytes may be the hash */
            hash = ost_hash(hash, size - sizeof hash, bytes);
            memmove(bytes, bytes + size - sizeof hash, sizeof hash);
            size = sizeof hash;
        }
    }
    memcpy(&stated, bytes, size < sizeof stated ? size : sizeof stated);
    OST_FREE(bytes);
    rewind(file);
    return size == sizeof hash && hash == stated ? OST_SUCCESS
                                                 : raise_damaged(ctx, name, "it is damaged or incomplete");
}

static OstStatus check_header(const OstPath *path, const char *name, const Header *found, const Header *expected)
{
    OstContext *ctx = path->ctx;
    char what[160];
    if (memcmp(found->magic, magic, sizeof magic) != 0 || found->version != VERSION)
        return raise_damaged(ctx, name, "another version of the program wrote it");
    snprintf(what, sizeof what, "it was made on %d rank%s and goes on there alone, but this run has %d", found->ranks,
             found->ranks == 1 ? "" : "s", expected->ranks);
    if (found->ranks != expected->ranks)
        return raise_damaged(ctx, name, what);
    if (found->case_hash != expected->case_hash)
        return raise_damaged(ctx, name, "it is that of another case, or the case file has changed since");
    if (found->problem_hash != expected->problem_hash || found->count != expected->count || found->done < 0 ||
        found->done > found->count)
        return raise_damaged(ctx, name, "mesh, axes, loads or constraints have changed since, or the partition has");
    return OST_SUCCESS;
}

static OstStatus get(OstContext *ctx, const char *name, FILE *file, size_t size, void *bytes)
{
    return fread(bytes, 1, size, file) == size ? OST_SUCCESS : raise_damaged(ctx, name, "it ends too early");
}

static OstStatus share(OstContext *ctx, size_t size, void *bytes)
{
    return OST_MPI(ctx, MPI_Bcast(bytes, (int)size, MPI_BYTE, 0, ost_comm(ctx)));
}

/* An array to all ranks, which each has the room it needs; `room` is rank 0's. */
static OstStatus get_array(OstContext *ctx, const char *name, FILE *file, OstGlobal count, double *values, double *room)
{
    const MPI_Comm comm = ost_comm(ctx);
    OstStatus status = OST_SUCCESS;
    for (int rank = 0; rank < ost_size(ctx); rank++) {
        OstGlobal stated = 0, asked = count;
        OST_TRY(OST_MPI(ctx, MPI_Bcast(&asked, 1, MPI_INT64_T, rank, comm)));
        if (ost_rank(ctx) == 0) {
            OST_THEN(get(ctx, name, file, sizeof stated, &stated));
            if (status == OST_SUCCESS && stated != asked)
                status = raise_damaged(ctx, name, "its arrays have another length");
            OST_THEN(get(ctx, name, file, (size_t)asked * sizeof *room, rank == 0 ? values : room));
            if (rank > 0)
                OST_TRY(OST_MPI(ctx, MPI_Send(room, (int)asked, MPI_DOUBLE, rank, 1, comm)));
        } else if (ost_rank(ctx) == rank) {
            OST_TRY(OST_MPI(ctx, MPI_Recv(values, (int)asked, MPI_DOUBLE, 0, 1, comm, MPI_STATUS_IGNORE)));
        }
    }
    return ost_agree(ctx, status);
}

/* Room for what `header` says will come. */
static OstStatus make_room(OstPath *path, const Header *header)
{
    path->decided = header->nonlinear || header->parts > 0; /* not before the first step */
    path->nonlinear = header->nonlinear;
    if (header->parts > 0)
        return ost_superposition_make_room(path->problem, &path->linear);
    if (!header->nonlinear)
        return OST_SUCCESS;
    OST_TRY(ost_agree(path->ctx, ost_newton_state_create(path->problem, &path->state)));
    path->state.t = header->t;
    path->state.step = header->step;
    return OST_SUCCESS;
}

/* The same on all ranks: rank 0 reads, and tells the others. */
static OstStatus get_reports(OstPath *path, const char *name, FILE *file)
{
    OstContext *ctx = path->ctx;
    OstSuperposition *linear = &path->linear;
    struct {
        size_t size;
        void *bytes;
    } const items[] = {{(size_t)path->done * sizeof *path->steps, path->steps},
                       {sizeof path->judged, &path->judged},
                       {sizeof linear->solve, &linear->solve},
                       {(size_t)linear->count * sizeof *linear->norm, linear->norm}};
    for (size_t i = 0; i < sizeof items / sizeof *items; i++) {
        OST_TRY(ost_agree(ctx, file ? get(ctx, name, file, items[i].size, items[i].bytes) : OST_SUCCESS));
        OST_TRY(share(ctx, items[i].size, items[i].bytes));
    }
    return OST_SUCCESS;
}

static OstStatus get_arrays(OstPath *path, const char *name, FILE *file)
{
    OstContext *ctx = path->ctx;
    const OstGlobal count = 3 * (OstGlobal)path->problem->mesh->node_count;
    OstGlobal largest = 0;
    double *room = NULL;
    OST_TRY(find_largest(path, &largest));
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &room, ost_rank(ctx) == 0 ? largest : 0)));
    OstStatus status = OST_SUCCESS;
    for (int k = 0; k < path->linear.count; k++)
        OST_THEN(get_array(ctx, name, file, count, path->linear.part[k], room));
    if (path->nonlinear) {
        status = get_array(ctx, name, file, count, path->state.displacement, room);
        OST_THEN(get_array(ctx, name, file, count, path->state.slope, room));
    }
    OST_FREE(room);
    return status;
}

static OstStatus get_head(const OstPath *path, const char *name, FILE *file, const Header *expected, Header *header)
{
    OstContext *ctx = path->ctx;
    OST_TRY(check_whole(ctx, name, file));
    OST_TRY(get(ctx, name, file, sizeof *header, header));
    return check_header(path, name, header, expected);
}

static OstStatus read_file(OstPath *path, const char *name, FILE *file)
{
    OstContext *ctx = path->ctx;
    Header expected, header;
    OST_TRY(describe(path, &expected));
    OST_TRY(ost_agree(ctx, file ? get_head(path, name, file, &expected, &header) : OST_SUCCESS));
    OST_TRY(share(ctx, sizeof header, &header));
    OST_TRY(make_room(path, &header));
    path->done = header.done;
    OST_TRY(get_reports(path, name, file));
    return get_arrays(path, name, file);
}

OstStatus ost_path_resume(OstPath *path, const char *name)
{
    OstContext *ctx = path->ctx;
    FILE *file = NULL;
    int found = 1;
    OstStatus status = OST_SUCCESS;
    ost_ledger_enter(ctx, OST_EFFECT_PATH);
    if (ost_rank(ctx) == 0) {
        file = fopen(name, "rb");
        found = file != NULL || errno != ENOENT;
        if (!file && found)
            status = OST_RAISE(ctx, OST_FILE_FAILED, "cannot read the checkpoint '%s': %s", name, strerror(errno));
    }
    status = ost_agree(ctx, status);
    OST_THEN(OST_MPI(ctx, MPI_Bcast(&found, 1, MPI_INT, 0, ost_comm(ctx))));
    if (found)
        OST_THEN(read_file(path, name, file));
    if (file)
        fclose(file);
    ost_ledger_leave(ctx);
    return status;
}
