# From SCENE.data of a chain scene: the insertions that liggghts-chains.in includes, 50 to a run. A region of 0.1 nm
# puts each chain in its place. Variable: spheres (per chain).
function insert(k, x, y, half) {
    printf "region r%d sphere %.17g %.17g 0 1e-10 units box volume_limit 1e-40\n", k, x, y
    printf "fix i%d all insert/pack seed 123457 distributiontemplate pdd insert_every once overlapcheck no " \
        "orientation constant %.17g 0 0 %.17g vel constant 0 0 0 verbose no region r%d particles_in_region 1 " \
        "ntry_mc 1001\n", k, cos(half), sin(half), k
}

function flush(n,    k) {
    print "run 1 post no"
    for (k = 0; k < n; k++) printf "unfix i%d\nregion r%d delete\n", k, k
}

/^Velocities/ { exit }
atoms && NF == 7 {
    k = ($1 - 1) % spheres
    if (k == 0) { x = y = 0; first = $5; second = $6 }
    x += $5 / spheres; y += $6 / spheres
    if (k < spheres - 1) next
    insert(pending++, x, y, atan2($6 - second, $5 - first) / 2)
    if (pending == 50) { flush(50); pending = 0 }
}
/^Atoms/ { atoms = 1 }
END { if (pending > 0) flush(pending) }
