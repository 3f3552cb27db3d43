/* frame.c - one moment of a world as an HDF5 file, for pictures, ParaView and studies.
 *
 *     /body/id, shape, position[n,3], orientation[n,4] (w x y z), velocity[n,3], spin[n,3]
 *     /body/rank                                                        where processes share it
 *     /body/image[n,3]                                                  where an axis is periodic
 *     /part/turn[p,4] (w x y z), shift[p,3], present                    clast_pose of every part
 *     /sphere/centre[m,3], radius, speed (single precision), body (id)
 *     /contact/a, b, point[k,3], force[k,3], normal_force, overlap      when asked for
 *
 * Bodies stand in the order of their ids, spheres in the order of their bodies and, within, of the
 * shape: so two frames of one run can be compared row by row. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/hdf5_io.h"
#include "engine/ranks.h"

static void *rows(size_t count, size_t size) {
    void *p = malloc(count * size + 1);
    CLAST_ASSERT(p);
    return p;
}

/* Columns side by side, rows in the given order. */
static void write_rows(h5_file *f, const char *name, const uint32_t *order, size_t count, int width,
                       const double *const *columns) {
    double *all = rows(count * (size_t)width, sizeof *all);
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < width; k++) all[i * (size_t)width + (size_t)k] = columns[k][order[i]];
    h5_write(f, name, H5_F64, 2, (size_t[]){count, (size_t)width}, all);
    free(all);
}

/* Times that the bodies have left by the upper face, less those by the lower one. */
static void write_images(h5_file *f, const clast_bodies *b, const uint32_t *order) {
    if (!b->image[0] && !b->image[1] && !b->image[2]) return;
    int32_t *all = rows(3 * b->count, sizeof *all);
    for (size_t i = 0; i < b->count; i++)
        for (size_t k = 0; k < 3; k++) all[3 * i + k] = b->image[k] ? b->image[k][order[i]] : 0;
    h5_write(f, "/body/image", H5_I32, 2, (size_t[]){b->count, 3}, all);
    free(all);
}

static void write_bodies(h5_file *f, const clast_bodies *b, const uint32_t *order) {
    size_t n = b->count;
    uint32_t *id = rows(n, sizeof *id);
    int32_t *shape_of = rows(n, sizeof *shape_of);
    for (size_t i = 0; i < n; i++) id[i] = b->id[order[i]], shape_of[i] = b->shape[order[i]];
    h5_write_column(f, "/body/id", H5_U32, n, id);
    h5_write_column(f, "/body/shape", H5_I32, n, shape_of);
    for (size_t i = 0; i < n && b->rank; i++) shape_of[i] = b->rank[order[i]];
    if (b->rank) h5_write_column(f, "/body/rank", H5_I32, n, shape_of);
    write_rows(f, "/body/position", order, n, 3, (const double *[]){b->x, b->y, b->z});
    write_rows(f, "/body/orientation", order, n, 4, (const double *[]){b->qw, b->qx, b->qy, b->qz});
    write_rows(f, "/body/velocity", order, n, 3, (const double *[]){b->vx, b->vy, b->vz});
    write_rows(f, "/body/spin", order, n, 3, (const double *[]){b->wx, b->wy, b->wz});
    write_images(f, b, order);
    free(id);
    free(shape_of);
}

static void write_parts(h5_file *f, const clast_world *w) {
    size_t n = (size_t)w->part_count;
    double *turn = rows(4 * n, sizeof *turn), *shift = rows(3 * n, sizeof *shift);
    int32_t *present = rows(n, sizeof *present);
    for (size_t i = 0; i < n; i++) {
        clast_pose p = clast_world_part_pose(w, (int)i);
        const double numbers[7] = {p.turn.w,  p.turn.x,  p.turn.y, p.turn.z,
                                   p.shift.x, p.shift.y, p.shift.z};
        memcpy(turn + 4 * i, numbers, 4 * sizeof *turn);
        memcpy(shift + 3 * i, numbers + 4, 3 * sizeof *shift);
        present[i] = w->parts[i].present;
    }
    h5_write(f, "/part/turn", H5_F64, 2, (size_t[]){n, 4}, turn);
    h5_write(f, "/part/shift", H5_F64, 2, (size_t[]){n, 3}, shift);
    h5_write_column(f, "/part/present", H5_I32, n, present);
    free(turn), free(shift), free(present);
}

/* Speed of the material at the centre of a sphere: v + omega x arm. */
static float speed_of(const clast_bodies *b, const clast_spheres *s, size_t sphere, size_t slot) {
    vec3 arm = v3(s->x[sphere] - b->x[slot], s->y[sphere] - b->y[slot], s->z[sphere] - b->z[slot]);
    vec3 spin = v3(b->wx[slot], b->wy[slot], b->wz[slot]);
    vec3 v = v3_add(v3(b->vx[slot], b->vy[slot], b->vz[slot]), v3_cross(spin, arm));
    return (float)sqrt(v3_dot(v, v));
}

static void write_spheres(h5_file *f, clast_world *w, const clast_bodies *b,
                          const uint32_t *order) {
    clast_spheres s = clast_world_spheres(w);
    size_t *first = rows(b->count + 1, sizeof *first), n = 0;
    for (size_t i = s.count; i-- > 0;) first[s.body[i]] = i; /* spheres are grouped by body */
    float *centre = rows(3 * s.count, sizeof *centre), *radius = rows(s.count, sizeof *radius),
          *speed = rows(s.count, sizeof *speed);
    uint32_t *body = rows(s.count, sizeof *body);
    for (size_t i = 0; i < b->count; i++) {
        size_t slot = order[i];
        for (size_t e = first[slot]; e < s.count && (size_t)s.body[e] == slot; e++, n++) {
            centre[3 * n] = (float)s.x[e];
            centre[3 * n + 1] = (float)s.y[e];
            centre[3 * n + 2] = (float)s.z[e];
            radius[n] = (float)s.radius[e];
            speed[n] = speed_of(b, &s, e, slot);
            body[n] = b->id[slot];
        }
    }
    CLAST_ASSERT(n == s.count);
    h5_write(f, "/sphere/centre", H5_F32, 2, (size_t[]){n, 3}, centre);
    h5_write_column(f, "/sphere/radius", H5_F32, n, radius);
    h5_write_column(f, "/sphere/speed", H5_F32, n, speed);
    h5_write_column(f, "/sphere/body", H5_U32, n, body);
    free(first), free(centre), free(radius), free(speed), free(body);
}

static void write_contacts(h5_file *f, clast_world *w) {
    size_t n = clast_world_contacts(w, NULL, 0);
    clast_contact *c = rows(n, sizeof *c);
    clast_world_contacts(w, c, n);
    uint32_t *a = rows(n, sizeof *a), *b = rows(n, sizeof *b);
    double *point = rows(3 * n, sizeof *point), *force = rows(3 * n, sizeof *force),
           *normal = rows(n, sizeof *normal), *overlap = rows(n, sizeof *overlap);
    for (size_t i = 0; i < n; i++) {
        a[i] = c[i].a, b[i] = c[i].b;
        point[3 * i] = c[i].point.x, point[3 * i + 1] = c[i].point.y,
                  point[3 * i + 2] = c[i].point.z;
        force[3 * i] = c[i].force.x, force[3 * i + 1] = c[i].force.y,
                  force[3 * i + 2] = c[i].force.z;
        normal[i] = c[i].normal_force, overlap[i] = c[i].overlap;
    }
    h5_write_column(f, "/contact/a", H5_U32, n, a);
    h5_write_column(f, "/contact/b", H5_U32, n, b);
    h5_write(f, "/contact/point", H5_F64, 2, (size_t[]){n, 3}, point);
    h5_write(f, "/contact/force", H5_F64, 2, (size_t[]){n, 3}, force);
    h5_write_column(f, "/contact/normal_force", H5_F64, n, normal);
    h5_write_column(f, "/contact/overlap", H5_F64, n, overlap);
    free(c), free(a), free(b), free(point), free(force), free(normal), free(overlap);
}

clast_status clast_frame_write(clast_world *w, const char *path, bool with_contacts) {
    CLAST_ASSERT(w && path);
    clast_bodies b = clast_world_bodies(w);
    uint32_t *order = bodies_by_id(w, &b);
    h5_file *f = ranks_speaks(w) ? h5_create(path) : h5_create_mute(path);
    h5_attribute_text(f, "/", "format", "clast frame");
    h5_attribute_u64(f, "/", "version", 1);
    h5_attribute_double(f, "/", "time", clast_world_time(w));
    h5_attribute_u64(f, "/", "step", clast_world_steps(w));
    write_bodies(f, &b, order);
    write_spheres(f, w, &b, order);
    write_parts(f, w);
    if (with_contacts) write_contacts(f, w);
    clast_status status = h5_publish(f);
    if (status != CLAST_OK) world_fail(w, status, "frame %s", h5_error(f));
    h5_free(f);
    free(order);
    return ranks_agree_status(w, status);
}
