/* A disk that records and fails, for one SQLite store. Loaded with LD_PRELOAD into the process that has the store open.

   DISK_STORE is the path of the store. Calls on the store, its -wal, its -journal and their folder are appended to the
   file DISK_LOG, in the order in which they take effect. Syncs are only recorded: the test plays the disk.
   DISK_FAULT is a file with a struct fault, which the test changes while the process runs. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

enum { STORE = 1, WAL, JOURNAL, FOLDER };                           /* files; 0 is any other file */
enum { WRITE = 1, SYNC = 2, TRUNCATE = 4, UNLINK = 8, CREATE = 16 }; /* calls */

struct record { /* followed by the bytes of a write */
    uint8_t call, file, failed, unused;
    uint32_t length;
    uint64_t inode;
    int64_t offset; /* of a write; of a truncation: the new size */
};

struct fault {
    int32_t number; /* the errno of calls that fail; 0: none fails */
    int32_t calls;  /* the calls that can fail: WRITE, SYNC or both */
    int32_t file;   /* the file whose calls can fail; 0: any */
    int32_t skip;   /* how many of them still succeed */
    int32_t times;  /* how many then fail; -1: all */
    int32_t failed; /* how many have failed */
};

#define REAL(name) ((__typeof__(&name))real(#name))

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_once_t once = PTHREAD_ONCE_INIT;
static char names[FOLDER + 1][PATH_MAX];
static uint8_t files[65536]; /* the file of each descriptor */
static struct fault *fault;
static int log_fd = -1;

static void *real(const char *name) { return dlsym(RTLD_NEXT, name); }

static void start(void) {
    const char *store = getenv("DISK_STORE");
    if (!store || strlen(store) + sizeof "-journal" > PATH_MAX) return;
    strcpy(names[STORE], store);
    strcat(strcpy(names[WAL], store), "-wal");
    strcat(strcpy(names[JOURNAL], store), "-journal");
    strcpy(names[FOLDER], store);
    *strrchr(names[FOLDER], '/') = 0;
    int shared = REAL(open64)(getenv("DISK_FAULT"), O_RDWR | O_CLOEXEC);
    log_fd = REAL(open64)(getenv("DISK_LOG"), O_WRONLY | O_APPEND | O_CLOEXEC);
    fault = mmap(NULL, sizeof *fault, PROT_READ | PROT_WRITE, MAP_SHARED, shared, 0);
    if (log_fd < 0 || fault == MAP_FAILED) abort();
}

static int file_of_name(const char *name) {
    pthread_once(&once, start);
    for (int file = STORE; file <= FOLDER; file++)
        if (*names[file] && !strcmp(name, names[file])) return file;
    return 0;
}

static int file_of(int fd) { return fd >= 0 && fd < (int)sizeof files ? files[fd] : 0; }

static void note(int call, int file, int failed, uint64_t inode, int64_t offset, const void *bytes, size_t length) {
    struct record record = {call, file, failed, 0, length, inode, offset};
    struct iovec parts[] = {{&record, sizeof record}, {(void *)bytes, length}};
    if (writev(log_fd, parts, 2) != (ssize_t)(sizeof record + length)) abort();
}

static void note_fd(int call, int fd, int failed, int64_t offset, const void *bytes, size_t length) {
    struct stat status;
    if (fstat(fd, &status)) abort();
    note(call, files[fd], failed, status.st_ino, offset, bytes, length);
}

static int fails(int call, int file) {
    if (!fault->number || !(fault->calls & call) || (fault->file && fault->file != file)) return 0;
    if (fault->skip > 0) return fault->skip--, 0;
    if (!fault->times) return 0;
    if (fault->times > 0) fault->times--;
    fault->failed++;
    return errno = fault->number;
}

static int needs_mode(int flags) { return flags & O_CREAT || (flags & O_TMPFILE) == O_TMPFILE; }

static int open_any(const char *name, int flags, mode_t mode) {
    int file = file_of_name(name);
    if (!file) return REAL(open64)(name, flags, mode);
    pthread_mutex_lock(&lock);
    int is_new = flags & O_CREAT && access(name, F_OK), fd = REAL(open64)(name, flags, mode);
    if (fd >= (int)sizeof files) abort();
    if (fd >= 0) {
        files[fd] = file;
        if (is_new) note_fd(CREATE, fd, 0, 0, NULL, 0);
    }
    pthread_mutex_unlock(&lock);
    return fd;
}

int open64(const char *name, int flags, ...) {
    va_list more;
    va_start(more, flags);
    mode_t mode = needs_mode(flags) ? va_arg(more, mode_t) : 0;
    va_end(more);
    return open_any(name, flags, mode);
}

int open(const char *name, int flags, ...) {
    va_list more;
    va_start(more, flags);
    mode_t mode = needs_mode(flags) ? va_arg(more, mode_t) : 0;
    va_end(more);
    return open_any(name, flags, mode);
}

int close(int fd) {
    if (fd >= 0 && fd < (int)sizeof files) files[fd] = 0;
    return REAL(close)(fd);
}

ssize_t pwrite64(int fd, const void *bytes, size_t length, off64_t offset) {
    if (!file_of(fd)) return REAL(pwrite64)(fd, bytes, length, offset);
    pthread_mutex_lock(&lock);
    int number = fails(WRITE, files[fd]);
    ssize_t done = REAL(pwrite64)(fd, bytes, number ? length / 2 : length, offset); /* a failed write leaves a half */
    if (done > 0) note_fd(WRITE, fd, !!number, offset, bytes, done);
    if (number) errno = number, done = -1;
    pthread_mutex_unlock(&lock);
    return done;
}

ssize_t pwrite(int fd, const void *bytes, size_t length, off_t offset) { return pwrite64(fd, bytes, length, offset); }

ssize_t write(int fd, const void *bytes, size_t length) {
    if (file_of(fd)) abort(); /* SQLite writes at offsets */
    return REAL(write)(fd, bytes, length);
}

static int sync_any(int fd) {
    pthread_mutex_lock(&lock);
    int number = fails(SYNC, files[fd]);
    note_fd(SYNC, fd, !!number, 0, NULL, 0);
    pthread_mutex_unlock(&lock);
    if (number) errno = number;
    return number ? -1 : 0;
}

int fsync(int fd) { return file_of(fd) ? sync_any(fd) : REAL(fsync)(fd); }

int fdatasync(int fd) { return file_of(fd) ? sync_any(fd) : REAL(fdatasync)(fd); }

int ftruncate64(int fd, off64_t size) {
    if (!file_of(fd)) return REAL(ftruncate64)(fd, size);
    pthread_mutex_lock(&lock);
    int done = REAL(ftruncate64)(fd, size);
    if (!done) note_fd(TRUNCATE, fd, 0, size, NULL, 0);
    pthread_mutex_unlock(&lock);
    return done;
}

int ftruncate(int fd, off_t size) { return ftruncate64(fd, size); }

int unlink(const char *name) {
    int file = file_of_name(name);
    if (!file) return REAL(unlink)(name);
    pthread_mutex_lock(&lock);
    struct stat status;
    int is_there = !stat(name, &status), done = REAL(unlink)(name), number = errno;
    if (is_there && !done) note(UNLINK, file, 0, status.st_ino, 0, NULL, 0);
    errno = number;
    pthread_mutex_unlock(&lock);
    return done;
}
