/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/write_aside.h"
#include "support.h"

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[256];
static char place[600];

static const char *in_folder(const char *name)
{
    snprintf(place, sizeof place, "%s/%s", folder, name);
    return place;
}

static int make_folder(void **state)
{
    const char *temporary = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%s/orthostat-aside-XXXXXX", temporary ? temporary : P_tmpdir);
    return mkdtemp(folder) ? 0 : -1;
}

static int files_in_folder(void)
{
    int count = 0;
    DIR *files = opendir(folder);
    for (struct dirent *file = readdir(files); file; file = readdir(files))
        count += strcmp(file->d_name, ".") != 0 && strcmp(file->d_name, "..") != 0;
    closedir(files);
    return count;
}

static int remove_folder(void **state)
{
    DIR *files = opendir(folder);
    for (struct dirent *file = readdir(files); file; file = readdir(files))
        remove(in_folder(file->d_name));
    closedir(files);
    return rmdir(folder);
}

static OstStatus write_words(FILE *file, const void *words)
{
    fputs(words, file);
    return OST_SUCCESS;
}

static OstStatus write_and_fail(FILE *file, const void *words)
{
    fputs(words, file);
    return OST_RAISE(ctx, OST_CHECK_FAILED, "no more");
}

static void assert_holds(const char *name, const char *words)
{
    char found[64] = "";
    FILE *file = fopen(in_folder(name), "r");
    assert_non_null(file);
    assert_non_null(fgets(found, sizeof found, file));
    fclose(file);
    assert_string_equal(found, words);
}

static void a_file_is_replaced_as_a_whole(void **state)
{
    assert_success(ost_write_aside(ctx, in_folder("file"), write_words, "first"));
    assert_success(ost_write_aside(ctx, in_folder("file"), write_words, "second"));
    assert_holds("file", "second");
    assert_int_equal(files_in_folder(), 1);
}

static void a_failure_leaves_the_old_file_and_nothing_else(void **state)
{
    assert_success(ost_write_aside(ctx, in_folder("file"), write_words, "old"));
    assert_failure(ost_write_aside(ctx, in_folder("file"), write_and_fail, "half"), OST_CHECK_FAILED, "no more");
    assert_holds("file", "old");
    assert_int_equal(files_in_folder(), 1);
}

static void two_runs_do_not_share_a_name(void **state)
{
    OstAside one = {0}, two = {0};
    assert_success(ost_aside_open(ctx, in_folder("file"), &one));
    assert_success(ost_aside_open(ctx, in_folder("file"), &two));
    assert_string_equal(one.path, two.path);
    assert_string_not_equal(one.aside, two.aside);
    assert_success(ost_aside_finish(ctx, &one, OST_SUCCESS));
    assert_int_equal(ost_aside_finish(ctx, &two, OST_CHECK_FAILED), OST_CHECK_FAILED);
    assert_int_equal(files_in_folder(), 1);
}

static void what_a_link_points_to_is_replaced(void **state)
{
    char deep[300], middle[300];
    struct stat facts;
    snprintf(deep, sizeof deep, "%s/deep", folder);
    snprintf(middle, sizeof middle, "%s/deep/link", folder);
    assert_int_equal(mkdir(deep, 0777), 0);
    assert_int_equal(symlink("../target", middle), 0);
    assert_int_equal(symlink("deep/link", in_folder("link")), 0);
    for (int i = 0; i < 2; i++) { /* the target is not there, then it is */
        assert_success(ost_write_aside(ctx, in_folder("link"), write_words, i ? "again" : "once"));
        assert_holds("target", i ? "again" : "once");
        assert_int_equal(lstat(in_folder("link"), &facts), 0);
        assert_true(S_ISLNK(facts.st_mode));
    }
    assert_int_equal(files_in_folder(), 3);
    assert_int_equal(remove(middle), 0);
}

static void a_circle_of_links_is_refused(void **state)
{
    assert_int_equal(symlink("circle", in_folder("circle")), 0);
    assert_failure(ost_write_aside(ctx, in_folder("circle"), write_words, "x"), OST_FILE_FAILED, "symbolic links");
    assert_int_equal(files_in_folder(), 1);
}

static void what_is_no_file_is_left_alone(void **state)
{
    assert_failure(ost_write_aside(ctx, folder, write_words, "x"), OST_FILE_FAILED, "not a regular file");
    assert_failure(ost_write_aside(ctx, "/dev/null", write_words, "x"), OST_FILE_FAILED, "not a regular file");
    int ends[2]; /* a link whose target can be opened, but has no name */
    char path[32];
    assert_int_equal(pipe(ends), 0);
    snprintf(path, sizeof path, "/proc/self/fd/%d", ends[1]);
    assert_failure(ost_write_aside(ctx, path, write_words, "x"), OST_FILE_FAILED, "'-' stands for standard output");
    close(ends[0]);
    close(ends[1]);
    assert_failure(ost_write_aside(ctx, in_folder("none/file"), write_words, "x"), OST_FILE_FAILED, "No such file");
    assert_int_equal(files_in_folder(), 0);
}

static void the_new_file_is_as_open_as_others(void **state)
{
    struct stat facts;
    const mode_t mask = umask(022);
    assert_success(ost_write_aside(ctx, in_folder("file"), write_words, "x"));
    umask(mask);
    assert_int_equal(stat(in_folder("file"), &facts), 0);
    assert_int_equal(facts.st_mode & 0777, 0644);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

static const struct CMUnitTest tests[] = {
    IN_FOLDER(a_file_is_replaced_as_a_whole),     IN_FOLDER(a_failure_leaves_the_old_file_and_nothing_else),
    IN_FOLDER(two_runs_do_not_share_a_name),      IN_FOLDER(what_a_link_points_to_is_replaced),
    IN_FOLDER(a_circle_of_links_is_refused),      IN_FOLDER(what_is_no_file_is_left_alone),
    IN_FOLDER(the_new_file_is_as_open_as_others),
};

OST_TEST_MAIN(tests)
