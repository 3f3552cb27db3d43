/* status.h: the three kinds of failure inside render/.
 * A broken invariant stops with file and line (RENDER_ASSERT, also in release); a costly check
 * exists in checked builds (RENDER_CHECK); the outside world returns a status through
 * render_fail(). */
#ifndef RENDER_STATUS_H
#define RENDER_STATUS_H

#include "render/render.h"

#define RENDER_ASSERT(cond) ((cond) ? (void)0 : render_panic(__FILE__, __LINE__, #cond))
#ifdef CLAST_CHECKED
#define RENDER_CHECK(cond) RENDER_ASSERT(cond)
#else
#define RENDER_CHECK(cond) ((void)0)
#endif

#if defined(__GNUC__)
#define RENDER_PRINTF(format_at, first_at) __attribute__((format(printf, format_at, first_at)))
#define RENDER_NORETURN                    __attribute__((noreturn))
#else
#define RENDER_PRINTF(format_at, first_at)
#define RENDER_NORETURN
#endif

RENDER_NORETURN void render_panic(const char *file, int line, const char *condition);

/* Keeps the text for render_error_text() of this thread and returns the code, so that a caller can
 * write `return render_fail(RENDER_ERR_FILE, "...", ...)`. */
render_status render_fail(render_status code, const char *format, ...) RENDER_PRINTF(2, 3);

#endif
