/* A disk that fails, preloaded into the program: calls on the files of one folder fail as they do
   where a quota is used up or a disk breaks. Everything else reaches the system.

   FAIL_BELOW  the folder, without links
   FAIL_CALL   write, fsync or close
   FAIL_FROM   the number of the first call that fails, from 0
   FAIL_TIMES  how many fail
   FAIL_WITH   the number of the error */

#define _GNU_SOURCE
#include <errno.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

static int fails(const char *call, int file)
{
    static atomic_long calls;
    const char *folder = getenv("FAIL_BELOW"), *failing = getenv("FAIL_CALL");
    char link[32], path[4096];
    if (!folder || !failing || strcmp(call, failing) != 0)
        return 0;
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    ssize_t length = readlink(link, path, sizeof path - 1);
    path[length < 0 ? 0 : length] = 0;
    if (strncmp(path, folder, strlen(folder)) != 0)
        return 0;
    long after = atomic_fetch_add(&calls, 1) - atol(getenv("FAIL_FROM"));
    if (after < 0 || after >= atol(getenv("FAIL_TIMES")))
        return 0;
    dprintf(2, "the disk fails: %s of %s\n", call, path);
    errno = atoi(getenv("FAIL_WITH"));
    return 1;
}

ssize_t write(int file, const void *bytes, size_t count)
{
    return fails("write", file) ? -1 : syscall(SYS_write, file, bytes, count);
}

int fsync(int file)
{
    return fails("fsync", file) ? -1 : (int)syscall(SYS_fsync, file);
}

int close(int file)
{
    int failed = fails("close", file), error = errno;
    int closed = (int)syscall(SYS_close, file);
    if (failed)
        errno = error;
    return failed ? -1 : closed;
}
