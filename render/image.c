#include "render/status.h"

#include <stdlib.h>
#include <string.h>

render_status render_image_resize(render_image *image, int width, int height) {
    RENDER_ASSERT(image);
    if (width < 1 || height < 1 || width > 65535 || height > 65535)
        return render_fail(RENDER_ERR_ARGUMENT,
                           "image of %d x %d pixels, expected 1 to 65535 in each direction", width,
                           height);
    size_t bytes = 3 * (size_t)width * (size_t)height;
    if (!image->rgb || image->width != width || image->height != height) {
        uint8_t *rgb = realloc(image->rgb, bytes);
        if (!rgb)
            return render_fail(RENDER_ERR_MEMORY, "no memory for an image of %d x %d pixels", width,
                               height);
        *image = (render_image){width, height, rgb};
    }
    memset(image->rgb, 255, bytes);
    return RENDER_OK;
}

void render_image_free(render_image *image) {
    RENDER_ASSERT(image);
    free(image->rgb);
    *image = (render_image){0};
}
