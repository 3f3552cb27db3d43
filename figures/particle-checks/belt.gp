# title: Dropped on a belt
# counterpart: A00 Fig. 3.12
# needs: belt.csv
# caption: Five spheres fall 1 mm (assumed) on a belt that runs at 0.01 m/s; speed along the belt. Where not varied: a tenth of the critical step, damping 0.21, friction 0.3. (a) Step, in parts of the critical one: no influence, where the source saw one; (b) damping; (c) friction.
width = 17; height = 7.5
load style
load tools.'/particle-checks/panels.gpi'
set multiplot
set bmargin at screen low(1, 1); set tmargin at screen high(1, 1)
set xrange [0:60]; set xtics 20; set format x '%g'; set format y '%g'; array most[3] = [18, 36, 18]
set xlabel 'time (ms)'; set ylabel 'speed (mm/s)'
set key at graph 0.98,0.98 right top
of(r, d, f) = rows('belt', sprintf('$1 == %g && $2 == %g && $3 == %g', r, d, f))
array part[3] = [1, 0.5, 0.1]; array damping[3] = [0.1, 0.21, 0.5]; array friction[3] = [0.1, 0.3, 0.5]
do for [i=1:3] {
    set lmargin at screen left(i, 3); set rmargin at screen right(i, 3)
    set yrange [0:most[i]]
    set label 1 letter(i) at graph 0,1.06
    if (i > 1) { unset label 999; set ylabel '' }
    if (i == 1) { plot 10 with lines lw 0.8 dt (6,4) lc rgb faint notitle, for [k=1:3] of(part[k], 0.21, 0.3) using ($4*1000):($5*1000) with lines lw 1.2 dt k lc rgb tone[2*k-1] title sprintf('step %g', part[k]) }
    if (i == 2) { plot 10 with lines lw 0.8 dt (6,4) lc rgb faint notitle, for [k=1:3] of(0.1, damping[k], 0.3) using ($4*1000):($5*1000) with lines lw 1.2 lc rgb tone[2*k-1] title sprintf('damping %g', damping[k]) }
    if (i == 3) { plot 10 with lines lw 0.8 dt (6,4) lc rgb faint notitle, for [k=1:3] of(0.1, 0.21, friction[k]) using ($4*1000):($5*1000) with lines lw 1.2 lc rgb tone[2*k-1] title sprintf('friction %g', friction[k]) }
}
unset multiplot
