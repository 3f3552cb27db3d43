#include "engine/hdf5_io.h"

#include <errno.h>
#include <fcntl.h>
#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/check.h"

struct h5_file {
    hid_t id;
    bool writing, published, mute;
    clast_status status;
    char *path, *temporary; /* temporary: NULL when reading */
    char error[H5_ERROR_MAX];
};

/* ---- the driver --------------------------------------------------------------------------------
 * HDF5 cannot close a file whose last blocks do not fit on the disk: it keeps the file open and
 * complains at exit. So the bytes go through a driver of ours that takes note of the first failed
 * write and tells HDF5 that all is well; h5_publish() then looks at the note, which holds the
 * reason in the words of the system. It takes no locks either, which some network file systems
 * refuse. */

typedef struct driver_file {
    H5FD_t base;             /* must be first: HDF5 knows a file by it */
    int descriptor, failure; /* failure: errno of the first write that failed */
    haddr_t allocated, end;
} driver_file;

/* Why the last open failed, and what the last file closed had met: HDF5 has no way to say. */
static int open_errno, close_errno;

static H5FD_t *driver_open(const char *name, unsigned flags, hid_t access, haddr_t maximum) {
    (void)access, (void)maximum;
    int mode = (flags & H5F_ACC_RDWR) ? O_RDWR : O_RDONLY;
    if (flags & H5F_ACC_CREAT) mode |= O_CREAT;
    if (flags & H5F_ACC_TRUNC) mode |= O_TRUNC;
    struct stat about;
    int descriptor = open(name, mode | O_CLOEXEC, 0666);
    if (descriptor < 0 || fstat(descriptor, &about) != 0) {
        open_errno = errno;
        if (descriptor >= 0) close(descriptor);
        return NULL;
    }
    driver_file *d = calloc(1, sizeof *d);
    CLAST_ASSERT(d);
    d->descriptor = descriptor;
    d->end = (haddr_t)about.st_size;
    return &d->base;
}

static herr_t driver_close(H5FD_t *file) {
    driver_file *d = (driver_file *)file;
    close_errno = d->failure;
    close(d->descriptor);
    free(d);
    return 0;
}

static herr_t driver_query(const H5FD_t *file, unsigned long *flags) {
    (void)file;
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

static haddr_t driver_get_eoa(const H5FD_t *file, H5FD_mem_t type) {
    (void)type;
    return ((const driver_file *)file)->allocated;
}

static herr_t driver_set_eoa(H5FD_t *file, H5FD_mem_t type, haddr_t address) {
    (void)type;
    ((driver_file *)file)->allocated = address;
    return 0;
}

static haddr_t driver_get_eof(const H5FD_t *file, H5FD_mem_t type) {
    (void)type;
    return ((const driver_file *)file)->end;
}

static herr_t driver_handle(H5FD_t *file, hid_t access, void **handle) {
    (void)access;
    *handle = file;
    return 0;
}

static herr_t driver_read(H5FD_t *file, H5FD_mem_t type, hid_t transfer, haddr_t address,
                          size_t size, void *buffer) {
    (void)type, (void)transfer;
    driver_file *d = (driver_file *)file;
    char *to = buffer;
    while (size > 0) {
        ssize_t got = pread(d->descriptor, to, size, (off_t)address);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return -1;
        if (got == 0) { /* HDF5 reads beyond what it has written and expects zeros */
            memset(to, 0, size);
            break;
        }
        to += got, address += (haddr_t)got, size -= (size_t)got;
    }
    return 0;
}

static herr_t driver_write(H5FD_t *file, H5FD_mem_t type, hid_t transfer, haddr_t address,
                           size_t size, const void *buffer) {
    (void)type, (void)transfer;
    driver_file *d = (driver_file *)file;
    const char *from = buffer;
    while (size > 0 && !d->failure) {
        ssize_t put = pwrite(d->descriptor, from, size, (off_t)address);
        if (put < 0 && errno == EINTR) continue;
        if (put <= 0) {
            d->failure = put < 0 ? errno : ENOSPC;
            break;
        }
        from += put, address += (haddr_t)put, size -= (size_t)put;
    }
    if (address + size > d->end) d->end = address + size;
    return 0;
}

static herr_t driver_truncate(H5FD_t *file, hid_t transfer, hbool_t closing) {
    (void)transfer, (void)closing;
    driver_file *d = (driver_file *)file;
    if (d->end == d->allocated) return 0;
    if (ftruncate(d->descriptor, (off_t)d->allocated) != 0 && !d->failure) d->failure = errno;
    d->end = d->allocated;
    return 0;
}

static const H5FD_class_t DRIVER = {
    .name = "clast",
    .maxaddr = ((haddr_t)1 << 62),
    .fc_degree = H5F_CLOSE_STRONG,
    .open = driver_open,
    .close = driver_close,
    .query = driver_query,
    .get_eoa = driver_get_eoa,
    .set_eoa = driver_set_eoa,
    .get_eof = driver_get_eof,
    .get_handle = driver_handle,
    .read = driver_read,
    .write = driver_write,
    .truncate = driver_truncate,
    .fl_map = H5FD_FLMAP_DICHOTOMY,
};

/* File access through the driver; made once, as HDF5 keeps the class until the program ends. */
static hid_t access_list(void) {
    static hid_t driver = -1, list = -1;
    if (list < 0) {
        H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
        driver = H5FDregister(&DRIVER);
        list = H5Pcreate(H5P_FILE_ACCESS);
        CLAST_ASSERT(driver >= 0 && list >= 0);
        CLAST_ASSERT(H5Pset_driver(list, driver, NULL) >= 0);
        CLAST_ASSERT(H5Pset_fclose_degree(list, H5F_CLOSE_STRONG) >= 0);
    }
    return list;
}

static int write_failure(const h5_file *f) {
    void *handle = NULL;
    if (f->id < 0 || H5Fget_vfd_handle(f->id, H5P_DEFAULT, &handle) < 0) return 0;
    return ((driver_file *)handle)->failure;
}

/* ---- failures -------------------------------------------------------------------------------- */

static herr_t innermost(unsigned n, const H5E_error2_t *error, void *text) {
    if (n == 0) snprintf(text, 256, "%s", error->desc ? error->desc : "unknown");
    return 0;
}

void h5_fail(h5_file *f, clast_status status, const char *format, ...) {
    CLAST_ASSERT(f && status != CLAST_OK && format);
    if (f->status != CLAST_OK) return;
    f->status = status;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(f->error, sizeof f->error, format, arguments);
    va_end(arguments);
}

/* For a failure inside HDF5: `what` was tried on `name`. */
static void fail(h5_file *f, const char *what, const char *name) {
    char reason[256] = "unknown reason";
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, reason);
    int failure = f->writing ? write_failure(f) : 0;
    if (failure) snprintf(reason, sizeof reason, "%s", strerror(failure));
    h5_fail(f, f->writing ? CLAST_ERR_WRITE : CLAST_ERR_FORMAT, "%s: cannot %s '%s': %s", f->path,
            what, name, reason);
}

clast_status h5_status(const h5_file *f) {
    CLAST_ASSERT(f);
    return f->mute ? CLAST_OK : f->status;
}

const char *h5_error(const h5_file *f) {
    CLAST_ASSERT(f);
    return f->error;
}

/* ---- opening and closing --------------------------------------------------------------------- */

static h5_file *file_new(const char *path, bool writing) {
    CLAST_ASSERT(path && path[0]);
    size_t length = strlen(path);
    h5_file *f = calloc(1, sizeof *f);
    CLAST_ASSERT(f);
    f->id = -1;
    f->writing = writing;
    f->path = malloc(length + 1);
    f->temporary = writing ? malloc(length + 5) : NULL;
    CLAST_ASSERT(f->path && (f->temporary || !writing));
    memcpy(f->path, path, length + 1);
    if (writing) snprintf(f->temporary, length + 5, "%s.tmp", path);
    return f;
}

h5_file *h5_create(const char *path) {
    h5_file *f = file_new(path, true);
    hid_t access = access_list();
    open_errno = 0;
    f->id = H5Fcreate(f->temporary, H5F_ACC_TRUNC, H5P_DEFAULT, access);
    if (f->id < 0)
        h5_fail(f, CLAST_ERR_WRITE, "%s: cannot be written: %s", path,
                open_errno ? strerror(open_errno) : "HDF5 cannot create a file there");
    return f;
}

h5_file *h5_create_mute(const char *path) {
    h5_file *f = file_new(path, true);
    f->mute = true;
    f->status = CLAST_ERR_WRITE; /* so that nothing is tried */
    return f;
}

h5_file *h5_open(const char *path) {
    h5_file *f = file_new(path, false);
    hid_t access = access_list();
    open_errno = 0;
    f->id = H5Fopen(path, H5F_ACC_RDONLY, access);
    if (f->id < 0 && open_errno)
        h5_fail(f, CLAST_ERR_OPEN, "%s: cannot be opened: %s", path, strerror(open_errno));
    else if (f->id < 0)
        h5_fail(f, CLAST_ERR_FORMAT,
                "%s: not a whole HDF5 file (cut off, damaged or of another kind)", path);
    return f;
}

/* A rename is on the disk only when its folder is. */
static int sync_folder(const char *path) {
    const char *slash = strrchr(path, '/');
    size_t length = slash == path ? 1 : slash ? (size_t)(slash - path) : 1;
    char *folder = malloc(length + 1);
    CLAST_ASSERT(folder);
    memcpy(folder, slash ? path : ".", length);
    folder[length] = '\0';
    int descriptor = open(folder, O_RDONLY | O_CLOEXEC);
    free(folder);
    if (descriptor < 0) return 0; /* a folder that may be written but not read: the file is there */
    int result = fsync(descriptor);
    close(descriptor);
    return result != 0 && errno != EINVAL ? -1 : 0;
}

/* Flushes HDF5's buffers, then those of the system; errno or 0. */
static int flush_to_disk(h5_file *f) {
    void *handle = NULL;
    if (H5Fflush(f->id, H5F_SCOPE_GLOBAL) < 0) return EIO;
    if (H5Fget_vfd_handle(f->id, H5P_DEFAULT, &handle) < 0) return EIO;
    driver_file *d = handle;
    if (d->failure) return d->failure;
    int copy = dup(d->descriptor); /* closing may still write, so the sync comes after it */
    if (copy < 0) return errno;
    H5Fclose(f->id);
    f->id = -1;
    int failure = close_errno;
    if (!failure && fsync(copy) != 0) failure = errno;
    close(copy);
    return failure;
}

clast_status h5_publish(h5_file *f) {
    CLAST_ASSERT(f && f->writing && !f->published);
    if (f->mute) return CLAST_OK;
    if (f->status != CLAST_OK) return f->status;
    int failure = flush_to_disk(f);
    if (!failure && rename(f->temporary, f->path) != 0) failure = errno;
    if (failure) {
        h5_fail(f, CLAST_ERR_WRITE, "%s: cannot be written: %s", f->path, strerror(failure));
        return f->status;
    }
    f->published = true;
    if (sync_folder(f->path) != 0)
        h5_fail(f, CLAST_ERR_WRITE, "%s: cannot be written: %s", f->path, strerror(errno));
    return f->status;
}

void h5_free(h5_file *f) {
    if (!f) return;
    if (f->id >= 0) H5Fclose(f->id);
    H5garbage_collect(); /* it keeps a megabyte of free blocks otherwise */
    if (f->writing && !f->published && !f->mute) remove(f->temporary);
    free(f->path);
    free(f->temporary);
    free(f);
}

/* ---- names ----------------------------------------------------------------------------------- */

static bool ready(const h5_file *f) {
    return f->status == CLAST_OK;
}

static hid_t making_groups(void) {
    static hid_t list = -1;
    if (list < 0) {
        list = H5Pcreate(H5P_LINK_CREATE);
        CLAST_ASSERT(list >= 0 && H5Pset_create_intermediate_group(list, 1) >= 0);
    }
    return list;
}

void h5_group(h5_file *f, const char *name) {
    CLAST_ASSERT(f && f->writing && name);
    if (!ready(f) || h5_has(f, name)) return;
    hid_t group = H5Gcreate2(f->id, name, making_groups(), H5P_DEFAULT, H5P_DEFAULT);
    if (group < 0) {
        fail(f, "make group", name);
        return;
    }
    H5Gclose(group);
}

/* H5Lexists wants every group on the way to exist, so it is asked for each of them. */
bool h5_has(h5_file *f, const char *name) {
    CLAST_ASSERT(f && name && strlen(name) < 512);
    if (!ready(f)) return false;
    if (strcmp(name, "/") == 0) return true;
    char part[512];
    for (const char *end = name + 1;; end++) {
        if (*end != '/' && *end != '\0') continue;
        snprintf(part, sizeof part, "%.*s", (int)(end - name), name);
        if (H5Lexists(f->id, part, H5P_DEFAULT) <= 0) return false;
        if (*end == '\0') return true;
    }
}

char *h5_member(h5_file *f, const char *group, size_t index) {
    CLAST_ASSERT(f && group);
    H5G_info_t about;
    if (!h5_has(f, group) || H5Gget_info_by_name(f->id, group, &about, H5P_DEFAULT) < 0)
        return NULL;
    if (index >= about.nlinks) return NULL;
    ssize_t length =
        H5Lget_name_by_idx(f->id, group, H5_INDEX_NAME, H5_ITER_INC, index, NULL, 0, H5P_DEFAULT);
    if (length <= 0) return NULL;
    char *name = malloc((size_t)length + 1);
    CLAST_ASSERT(name);
    H5Lget_name_by_idx(f->id, group, H5_INDEX_NAME, H5_ITER_INC, index, name, (size_t)length + 1,
                       H5P_DEFAULT);
    return name;
}

/* ---- arrays ---------------------------------------------------------------------------------- */

static hid_t native(h5_type type) {
    switch (type) {
    case H5_F64:
        return H5T_NATIVE_DOUBLE;
    case H5_F32:
        return H5T_NATIVE_FLOAT;
    case H5_I32:
        return H5T_NATIVE_INT32;
    case H5_U32:
        return H5T_NATIVE_UINT32;
    case H5_U64:
        return H5T_NATIVE_UINT64;
    case H5_U8:
        return H5T_NATIVE_UINT8;
    }
    CLAST_ASSERT(!"h5_type");
    return -1;
}

static size_t size_of(h5_type type) {
    return type == H5_F64 || type == H5_U64 ? 8 : type == H5_U8 ? 1 : 4;
}

/* How a dataset is laid out: small ones whole, large ones in deflated chunks of about 256 KiB.
 * Files do not hold the time of day, so that equal results are equal files. */
static hid_t layout(h5_type type, int rank, const hsize_t *extent) {
    hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    CLAST_ASSERT(list >= 0 && H5Pset_obj_track_times(list, false) >= 0);
    size_t row = size_of(type);
    for (int i = 1; i < rank; i++) row *= (size_t)extent[i];
    if (row == 0 || row * extent[0] < 4096) return list;
    hsize_t chunk[H5_RANK_MAX];
    memcpy(chunk, extent, sizeof chunk);
    hsize_t rows = (hsize_t)262144 / row;
    if (chunk[0] > rows) chunk[0] = rows > 0 ? rows : 1;
    CLAST_ASSERT(H5Pset_chunk(list, rank, chunk) >= 0);
    CLAST_ASSERT(H5Pset_shuffle(list) >= 0 && H5Pset_deflate(list, 2) >= 0);
    return list;
}

void h5_write(h5_file *f, const char *name, h5_type type, int rank, const size_t *extent,
              const void *data) {
    CLAST_ASSERT(f && f->writing && name && extent && rank >= 1 && rank <= H5_RANK_MAX);
    if (!ready(f)) return;
    hsize_t size[H5_RANK_MAX] = {0};
    size_t count = 1;
    for (int i = 0; i < rank; i++) size[i] = extent[i], count *= extent[i];
    CLAST_ASSERT(data || count == 0);
    hid_t space = H5Screate_simple(rank, size, NULL);
    hid_t list = layout(type, rank, size);
    hid_t set = H5Dcreate2(f->id, name, native(type), space, making_groups(), list, H5P_DEFAULT);
    if (set < 0 ||
        (count > 0 && H5Dwrite(set, native(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0))
        fail(f, "write", name);
    if (set >= 0) H5Dclose(set);
    H5Pclose(list);
    H5Sclose(space);
    int failure = write_failure(f); /* stop at once, do not fill a full disk further */
    if (failure) fail(f, "write", name);
}

void h5_write_column(h5_file *f, const char *name, h5_type type, size_t count, const void *data) {
    h5_write(f, name, type, 1, &count, data);
}

/* An open dataset, or -1 with the failure noted. */
static hid_t dataset(h5_file *f, const char *name) {
    if (!ready(f)) return -1;
    if (!h5_has(f, name)) {
        h5_fail(f, CLAST_ERR_FORMAT, "%s: holds no '%s'", f->path, name);
        return -1;
    }
    hid_t set = H5Dopen2(f->id, name, H5P_DEFAULT);
    if (set < 0) fail(f, "open", name);
    return set;
}

/* Deflate makes nothing smaller than a 1032nd: what claims to hold more than that many times the
 * bytes that are stored is damaged, and must not be believed before memory is asked for. */
static bool is_stored(hid_t set, const hsize_t *size, int rank) {
    hid_t type = H5Dget_type(set);
    double claimed = (double)H5Tget_size(type);
    H5Tclose(type);
    for (int i = 0; i < rank; i++) claimed *= (double)size[i];
    return claimed <= 1032.0 * (double)H5Dget_storage_size(set);
}

int h5_extent(h5_file *f, const char *name, size_t extent[H5_RANK_MAX]) {
    CLAST_ASSERT(f && name && extent);
    memset(extent, 0, H5_RANK_MAX * sizeof *extent);
    hid_t set = dataset(f, name);
    if (set < 0) return 0;
    hid_t space = H5Dget_space(set);
    hsize_t size[H5_RANK_MAX] = {0};
    int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 0 || rank > H5_RANK_MAX || H5Sget_simple_extent_dims(space, size, NULL) < 0) {
        h5_fail(f, CLAST_ERR_FORMAT, "%s: '%s' has an unexpected shape", f->path, name);
        rank = 0;
    }
    if (!is_stored(set, size, rank)) {
        h5_fail(f, CLAST_ERR_FORMAT, "%s: '%s' claims to hold more than is stored", f->path, name);
        rank = 0;
    }
    for (int i = 0; i < rank; i++) extent[i] = (size_t)size[i];
    H5Sclose(space);
    H5Dclose(set);
    return rank;
}

size_t h5_count(h5_file *f, const char *name) {
    size_t extent[H5_RANK_MAX], count = 1;
    int rank = h5_extent(f, name, extent);
    for (int i = 0; i < rank; i++) count *= extent[i];
    return ready(f) ? count : 0;
}

void h5_read(h5_file *f, const char *name, h5_type type, size_t count, void *data) {
    CLAST_ASSERT(f && name && (data || count == 0));
    if (count > 0) memset(data, 0, count * size_of(type));
    size_t there = h5_count(f, name);
    if (!ready(f)) return;
    if (there != count) {
        h5_fail(f, CLAST_ERR_FORMAT, "%s: '%s' holds %zu numbers, expected %zu", f->path, name,
                there, count);
        return;
    }
    hid_t set = count > 0 ? dataset(f, name) : -1;
    if (set < 0) return;
    if (H5Dread(set, native(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) fail(f, "read", name);
    H5Dclose(set);
}

void *h5_read_all(h5_file *f, const char *name, h5_type type, size_t *count) {
    CLAST_ASSERT(f && name && count);
    *count = h5_count(f, name);
    void *data = calloc(*count + 1, size_of(type));
    if (!data) {
        h5_fail(f, CLAST_ERR_FORMAT, "%s: '%s' does not fit into memory", f->path, name);
        *count = 0;
        data = calloc(1, 8);
        CLAST_ASSERT(data);
    }
    h5_read(f, name, type, *count, data);
    if (!ready(f)) *count = 0;
    return data;
}

/* ---- texts and attributes -------------------------------------------------------------------- */

/* Texts are arrays of bytes without the final nul: no limit on length, and nothing to convert. */
void h5_write_text(h5_file *f, const char *name, const char *text) {
    CLAST_ASSERT(text);
    h5_write_column(f, name, H5_U8, strlen(text), text);
}

char *h5_read_text(h5_file *f, const char *name) {
    size_t count;
    return h5_read_all(f, name, H5_U8,
                       &count); /* one element longer than asked, zero: ends the text */
}

static void write_attribute(h5_file *f, const char *object, const char *name, hid_t type,
                            const void *value) {
    CLAST_ASSERT(f && f->writing && object && name && value);
    if (!ready(f)) return;
    hid_t space = H5Screate(H5S_SCALAR);
    hid_t at =
        H5Acreate_by_name(f->id, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (at < 0 || H5Awrite(at, type, value) < 0) fail(f, "write attribute", name);
    if (at >= 0) H5Aclose(at);
    H5Sclose(space);
}

static hid_t text_type(size_t length) {
    hid_t type = H5Tcopy(H5T_C_S1);
    CLAST_ASSERT(type >= 0 && H5Tset_size(type, length + 1) >= 0);
    CLAST_ASSERT(H5Tset_cset(type, H5T_CSET_UTF8) >= 0);
    return type;
}

void h5_attribute_text(h5_file *f, const char *object, const char *name, const char *text) {
    CLAST_ASSERT(text && strlen(text) < 60000); /* HDF5 keeps attributes below 64 KiB */
    hid_t type = text_type(strlen(text));
    write_attribute(f, object, name, type, text);
    H5Tclose(type);
}

void h5_attribute_double(h5_file *f, const char *object, const char *name, double value) {
    write_attribute(f, object, name, H5T_NATIVE_DOUBLE, &value);
}

void h5_attribute_u64(h5_file *f, const char *object, const char *name, uint64_t value) {
    write_attribute(f, object, name, H5T_NATIVE_UINT64, &value);
}

static hid_t open_attribute(h5_file *f, const char *object, const char *name) {
    CLAST_ASSERT(f && object && name);
    if (!ready(f)) return -1;
    hid_t at =
        h5_has(f, object) ? H5Aopen_by_name(f->id, object, name, H5P_DEFAULT, H5P_DEFAULT) : -1;
    if (at < 0) h5_fail(f, CLAST_ERR_FORMAT, "%s: '%s' has no '%s'", f->path, object, name);
    return at;
}

static void read_attribute(h5_file *f, const char *object, const char *name, hid_t type,
                           void *value) {
    hid_t at = open_attribute(f, object, name);
    if (at < 0) return;
    if (H5Aread(at, type, value) < 0) fail(f, "read attribute", name);
    H5Aclose(at);
}

double h5_double_attribute(h5_file *f, const char *object, const char *name) {
    double value = 0;
    read_attribute(f, object, name, H5T_NATIVE_DOUBLE, &value);
    return value;
}

uint64_t h5_u64_attribute(h5_file *f, const char *object, const char *name) {
    uint64_t value = 0;
    read_attribute(f, object, name, H5T_NATIVE_UINT64, &value);
    return value;
}

char *h5_text_attribute(h5_file *f, const char *object, const char *name) {
    hid_t at = open_attribute(f, object, name);
    size_t length = at >= 0 ? (size_t)H5Aget_storage_size(at) : 0;
    char *text = calloc(length + 1, 1);
    CLAST_ASSERT(text);
    if (at < 0) return text;
    hid_t type = text_type(length);
    if (H5Aread(at, type, text) < 0) fail(f, "read attribute", name);
    H5Tclose(type);
    H5Aclose(at);
    return text;
}

/* ---- copying --------------------------------------------------------------------------------- */

void h5_copy(h5_file *from, const char *name, h5_file *to, const char *new_name) {
    CLAST_ASSERT(from && to && to->writing && name && new_name);
    if (!ready(to)) return;
    if (!ready(from)) {
        h5_fail(to, from->status, "%s", from->error);
        return;
    }
    if (H5Ocopy(from->id, name, to->id, new_name, H5P_DEFAULT, making_groups()) < 0)
        fail(to, "copy", name);
    int failure = write_failure(to);
    if (failure) fail(to, "copy", name);
}

const char *h5_library_version(void) {
    static char text[32];
    unsigned major = 0, minor = 0, release = 0;
    H5get_libversion(&major, &minor, &release);
    snprintf(text, sizeof text, "%u.%u.%u", major, minor, release);
    return text;
}
