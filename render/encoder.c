#include "render/clock.h"
#include "render/status.h"

#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAGIC = 0x656e636f };

/* One picture on its way to disk. Slots are reused, so their images keep their memory. */
typedef struct slot {
    render_image image;
    render_overlay overlay;
    bool labelled;
    render_tag *tags; /* one block: the tags, then their characters */
    size_t tag_count;
    int number;
} slot;

struct render_encoder {
    char *folder, *stem;
    char *font_path;   /* NULL: the usual places */
    render_font *font; /* opened by the first push with labels, then used by the thread alone */
    pthread_t thread;
    pthread_mutex_t lock; /* guards all that follows */
    pthread_cond_t filled, emptied;
    slot *ring;
    int size, head, waiting; /* ring[head] is the oldest of `waiting` */
    int next;                /* number of the next picture */
    bool finishing;
    render_status failure;
    char failure_text[1024];
    render_encoder_timing timing;
};

render_encoder_def render_encoder_default(void) {
    return (render_encoder_def){.stem = "frame", .first = 0, .queue = 3, .magic = MAGIC};
}

/* ---- The thread ---- */

static render_status write_slot(render_encoder *e, slot *s, double spent[2]) {
    char path[4096];
    int length = snprintf(path, sizeof path, "%s/%s-%06d.png", e->folder, e->stem, s->number);
    if (length < 0 || (size_t)length >= sizeof path)
        return render_fail(RENDER_ERR_FILE, "%s: the path is too long", e->folder);
    double start = render_clock_s();
    render_status status =
        s->labelled ? render_overlay_draw(e->font, &s->overlay, &s->image) : RENDER_OK;
    double labelled = render_clock_s();
    if (status == RENDER_OK) status = render_png_write(path, &s->image, s->tags, s->tag_count);
    spent[0] = labelled - start;
    spent[1] = render_clock_s() - labelled;
    return status;
}

/* The oldest slot, or NULL when there will be no more. Holds the lock. */
static slot *wait_for_slot(render_encoder *e) {
    while (e->waiting == 0 && !e->finishing) pthread_cond_wait(&e->filled, &e->lock);
    return e->waiting > 0 ? &e->ring[e->head] : NULL;
}

static void *encode_all(void *argument) {
    render_encoder *e = argument;
    pthread_mutex_lock(&e->lock);
    for (slot *s; (s = wait_for_slot(e)) != NULL;) {
        if (e->failure == RENDER_OK) {
            double spent[2];
            pthread_mutex_unlock(&e->lock);
            render_status status = write_slot(e, s, spent);
            pthread_mutex_lock(&e->lock);
            e->timing.label_s += spent[0];
            e->timing.png_s += spent[1];
            e->timing.written += status == RENDER_OK;
            e->failure = status;
            if (status != RENDER_OK)
                snprintf(e->failure_text, sizeof e->failure_text, "%s", render_error_text());
        }
        e->head = (e->head + 1) % e->size;
        e->waiting--;
        pthread_cond_signal(&e->emptied);
    }
    pthread_mutex_unlock(&e->lock);
    return NULL;
}

/* ---- The caller's side ---- */

static void free_encoder(render_encoder *e) {
    for (int i = 0; e->ring && i < e->size; i++) {
        render_image_free(&e->ring[i].image);
        free(e->ring[i].tags);
    }
    free(e->ring);
    render_font_close(e->font);
    free(e->folder);
    free(e->stem);
    free(e->font_path);
    free(e);
}

static render_status check_def(const render_encoder_def *def) {
    RENDER_ASSERT(def->magic == MAGIC);
    if (!def->folder || !def->stem || !*def->stem || strchr(def->stem, '/'))
        return render_fail(RENDER_ERR_ARGUMENT,
                           "encoder: a folder and a stem without slashes expected");
    if (def->first < 0 || def->queue < 1 || def->queue > 1000)
        return render_fail(RENDER_ERR_ARGUMENT,
                           "encoder: first picture %d (expected >= 0), queue of %d (expected 1 to "
                           "1000)",
                           def->first, def->queue);
    return RENDER_OK;
}

/* Finds out early, so that no hour of drawing is lost to a folder that cannot be written. */
static render_status probe_folder(const render_encoder *e) {
    char path[4096];
    int length = snprintf(path, sizeof path, "%s/%s.part", e->folder, e->stem);
    FILE *file = length > 0 && (size_t)length < sizeof path ? fopen(path, "wb") : NULL;
    if (!file)
        return render_fail(RENDER_ERR_FILE, "%s: cannot write there: %s", e->folder,
                           strerror(errno));
    fclose(file);
    remove(path);
    return RENDER_OK;
}

static render_status start(render_encoder *e) {
    int error = pthread_mutex_init(&e->lock, NULL);
    if (error == 0) error = pthread_cond_init(&e->filled, NULL);
    if (error == 0) error = pthread_cond_init(&e->emptied, NULL);
    if (error == 0) error = pthread_create(&e->thread, NULL, encode_all, e);
    if (error == 0) return RENDER_OK;
    return render_fail(RENDER_ERR_MEMORY, "encoder: no thread: %s", strerror(error));
}

render_status render_encoder_new(const render_encoder_def *def, render_encoder **encoder) {
    RENDER_ASSERT(def && encoder);
    *encoder = NULL;
    render_status status = check_def(def);
    if (status != RENDER_OK) return status;
    render_encoder *e = calloc(1, sizeof *e);
    if (!e) return render_fail(RENDER_ERR_MEMORY, "no memory for an encoder");
    e->folder = strdup(def->folder);
    e->stem = strdup(def->stem);
    e->font_path = def->font ? strdup(def->font) : NULL;
    e->size = def->queue;
    e->next = def->first;
    e->ring = calloc((size_t)def->queue, sizeof *e->ring);
    if (!e->folder || !e->stem || !e->ring || (def->font && !e->font_path))
        status = render_fail(RENDER_ERR_MEMORY, "no memory for an encoder");
    if (status == RENDER_OK) status = probe_folder(e);
    if (status == RENDER_OK) status = start(e);
    if (status == RENDER_OK)
        *encoder = e;
    else
        free_encoder(e);
    return status;
}

/* One block holds the tags and all their characters. */
static render_status copy_tags(slot *s, const render_tag *tags, size_t count) {
    free(s->tags);
    s->tags = NULL;
    s->tag_count = 0;
    if (count == 0) return RENDER_OK;
    size_t bytes = count * sizeof *tags;
    for (size_t i = 0; i < count; i++) {
        if (!tags[i].key || !tags[i].text)
            return render_fail(RENDER_ERR_ARGUMENT, "PNG metadata %zu: no key or no text", i);
        bytes += strlen(tags[i].key) + strlen(tags[i].text) + 2;
    }
    s->tags = malloc(bytes);
    if (!s->tags) return render_fail(RENDER_ERR_MEMORY, "no memory for PNG metadata");
    char *text = (char *)(s->tags + count);
    for (size_t i = 0; i < count; i++) {
        s->tags[i].key = strcpy(text, tags[i].key);
        text += strlen(text) + 1;
        s->tags[i].text = strcpy(text, tags[i].text);
        text += strlen(text) + 1;
    }
    s->tag_count = count;
    return RENDER_OK;
}

static render_status fill_slot(slot *s, const render_image *image, const render_overlay *overlay,
                               const render_tag *tags, size_t tag_count) {
    render_status status = render_image_resize(&s->image, image->width, image->height);
    if (status != RENDER_OK) return status;
    memcpy(s->image.rgb, image->rgb, 3 * (size_t)image->width * (size_t)image->height);
    s->labelled = overlay != NULL;
    if (overlay) s->overlay = *overlay;
    return copy_tags(s, tags, tag_count);
}

/* With the lock held: what the thread has met, with its text in this thread. */
static render_status repeat_failure(const render_encoder *e) {
    return e->failure == RENDER_OK ? RENDER_OK : render_fail(e->failure, "%s", e->failure_text);
}

render_status render_encoder_push(render_encoder *encoder, const render_image *image,
                                  const render_overlay *overlay, const render_tag *tags,
                                  size_t tag_count) {
    RENDER_ASSERT(encoder && image && (tag_count == 0 || tags));
    if (!image->rgb) return render_fail(RENDER_ERR_ARGUMENT, "encoder: the image is empty");
    render_encoder *e = encoder;
    if (overlay && !e->font) { /* pictures without labels need no font on the machine */
        render_status opened = render_font_open(e->font_path, &e->font);
        if (opened != RENDER_OK) return opened;
    }
    pthread_mutex_lock(&e->lock);
    while (e->waiting == e->size && e->failure == RENDER_OK)
        pthread_cond_wait(&e->emptied, &e->lock);
    render_status status = repeat_failure(e);
    slot *free_slot = &e->ring[(e->head + e->waiting) % e->size];
    pthread_mutex_unlock(&e->lock);
    if (status != RENDER_OK) return status;

    /* Only this thread fills slots, and the encoder does not look at this one yet. */
    status = fill_slot(free_slot, image, overlay, tags, tag_count);
    if (status != RENDER_OK) return status;
    pthread_mutex_lock(&e->lock);
    free_slot->number = e->next++;
    e->waiting++;
    pthread_cond_signal(&e->filled);
    pthread_mutex_unlock(&e->lock);
    return RENDER_OK;
}

render_encoder_timing render_encoder_times(render_encoder *encoder) {
    RENDER_ASSERT(encoder);
    pthread_mutex_lock(&encoder->lock);
    render_encoder_timing timing = encoder->timing;
    pthread_mutex_unlock(&encoder->lock);
    return timing;
}

render_status render_encoder_finish(render_encoder *encoder) {
    RENDER_ASSERT(encoder);
    pthread_mutex_lock(&encoder->lock);
    encoder->finishing = true;
    pthread_cond_signal(&encoder->filled);
    pthread_mutex_unlock(&encoder->lock);
    pthread_join(encoder->thread, NULL);
    render_status status = repeat_failure(encoder);
    pthread_cond_destroy(&encoder->emptied);
    pthread_cond_destroy(&encoder->filled);
    pthread_mutex_destroy(&encoder->lock);
    free_encoder(encoder);
    return status;
}
