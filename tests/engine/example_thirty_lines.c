/* Marbles dropped into a tray, by the public header alone. */
#include <stdio.h>

#include "engine/clast.h"

int main(void) {
    clast_world_def def = clast_world_def_default();
    def.impact_speed = 1.5;
    clast_world *w = clast_world_new(&def);
    int glass = clast_material_add(w, &(clast_material_def){"glass", 2500, 3e8, 0.22});
    clast_pair_set(w, glass, glass, &(clast_pair_def){.restitution = 0.6, .friction = 0.3});
    int marble = clast_shape_add_sphere(w, "marble", 0.005, glass);
    int tray = clast_part_add(w, &(clast_part_def){.name = "tray"});
    clast_vec3 n[5] = {{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    for (int i = 0; i < 5; i++)
        clast_wall_add(w, tray, &(clast_wall_def){.name = "side", .material = glass, .normal = n[i],
                                                  .point = {-0.03 * n[i].x, -0.03 * n[i].y, 0}});
    for (int i = 0; i < 50; i++) {
        clast_vec3 p = {0.011 * (i % 5 - 2), 0.011 * (i / 5 % 5 - 2), 0.03 + 0.011 * (i / 25)};
        clast_body_add(w, &(clast_body_def){marble, p, {1, 0, 0, 0}, {0.1, 0, 0}, {0, 0, 0}});
    }
    if (clast_world_run(w, 0.3) != CLAST_OK) puts(clast_world_error(w));
    clast_energy e = clast_world_energy(w);
    size_t contacts = clast_world_contacts(w, NULL, 0);
    printf("%zu contacts, %.4f mJ of motion left, residual %.1e\n", contacts,
           1e3 * (e.kinetic + e.rotational), e.residual / e.input);
    printf("hash: 0x%016llx\n", (unsigned long long)clast_world_hash(w));
    clast_world_free(w);
}
