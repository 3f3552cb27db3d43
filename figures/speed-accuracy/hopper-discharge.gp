# title: Hopper discharge: error against cost
# counterpart: S12 Figs 3.14 to 3.16 have the mean residence time against the step
# needs: points.csv discharge.csv
# caption: 2010 spheres (S12 3.9.3), runs of the study hopper-discharge: explicit and implicit schemes and the engine's leapfrog at several steps. Above: mean residence time, size of the mean difference from the run of the same method and initial state with the smallest step, with its 95 % interval over the states; triangles: the interval holds zero, the difference is at most where the triangle is. Below: error of the energy, which is known for the smallest step, too. Left against processor time, right against force evaluations.
width = 17; height = 15
load style
load tools.'/speed-accuracy/statistical.gpi'
known = system(sprintf("awk -F, '$1 == \"hopper-discharge\" && !($4 in seen) { seen[$4] = 1; printf \"%%s \", $4 }' '%s/points.csv'", data))
families = words(known)
array family_key[8]; array family_tint[8] = ['#1a1a1a', '#009E73', '#0072B2', '#D55E00', '#CC79A7', '#E69F00', '#882255', '#44AA99']
array family_mark[8] = [7, 5, 9, 13, 4, 6, 8, 12]
do for [k=1:families] { family_key[k] = word(known, k) }
array quantity[2] = ['residence', 'energy']
array ytitle[2] = ['error of the mean residence time', 'error of the energy']
set multiplot
set ytics 10
do for [i=1:4] {
    column = i % 2 ? 0 : 1; row = i > 2 ? 1 : 0
    set yrange [(row == 0 ? 1e-3 : 1e-5):1]
    set lmargin at screen left_of(i); set rmargin at screen right_of(i); set bmargin at screen bottom_of(i, 0.7); set tmargin at screen top_of(i, 0.7)
    set ylabel (column == 0 ? ytitle[row + 1] : '')
    axis = column == 0 ? 8 : 11
    set xlabel (row == 1 ? (axis == 8 ? cost_title : 'force evaluations per run') : '')
    if (i > 1) { unset label 999; unset key } else { set key at screen 0.53,1 - up(0.1) center top maxrows 1 font small }
    panel = of_panel('hopper-discharge', 'S12 3.9.3', quantity[row + 1])
    plot front(panel, axis) using 1:2 with steps lw 2 lc rgb ink notitle, \
         for [k=1:families] seen(panel, k) using axis:13:(floor_of($14)):15 with yerrorbars pt family_mark[k] ps 0.8 lw 1.1 lc rgb family_tint[k] title nice(family_key[k]), \
         for [k=1:families] unseen(panel, k) using axis:15 with points pt 11 ps 0.9 lc rgb family_tint[k] notitle
}
unset multiplot
