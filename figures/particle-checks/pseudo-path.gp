# title: Sliding over lobes
# counterpart: A00 Fig. 3.17
# needs: pseudo_path.csv pseudo_path_crest.csv
# caption: Square of the time against the way of a particle of aspect ratio 5 over others like it, no friction, 30 degrees, 1, 2 and 4 spheres per diameter; straight lines: slope of the source's friction (A00 3.13, Table 3.4). (a) From rest in a nest, as in the source: at q = 1 the nest is as steep as the slope, so the particle waits. (b) From a crest.
width = 17; height = 8
load style
load tools.'/particle-checks/panels.gpi'
array q[3] = [1, 2, 4]
array printed[3] = [0.41, 0.22, 0.03]
slope(mu) = 2 / (9.81 * (0.5 - mu * sqrt(0.75)))
set multiplot
set bmargin at screen low(1, 1); set tmargin at screen high(1, 1)
set xrange [0:0.17]; set yrange [0:0.3]; set xtics 0.05; set xlabel 'way (m)'; set ylabel 'time² (s²)'
set key at graph 0.03,0.98 left top
do for [i=1:2] {
    of(k) = rows(i == 1 ? 'pseudo_path' : 'pseudo_path_crest', sprintf('$1 == %g', k))
    set lmargin at screen left(i, 2); set rmargin at screen right(i, 2)
    set label 1 letter(i) at graph 0,1.06
    plot for [k=1:3] slope(printed[k]) * x with lines lw 0.9 dt (6,4) lc rgb tone[2*k-1] notitle, \
         for [k=1:3] of(q[k]) using 2:3 with lines lw 1.4 lc rgb tone[2*k-1] title sprintf('q = %d', q[k])
    unset label 999
}
unset multiplot
