# title: Button hopper: error against cost
# counterpart: none, our own measurement
# needs: points.csv button_runs.csv
# caption: Flow rate (above) and bulk density of the flowing bed (below) at an orifice of 10 cm, one thing changed at a time from the thesis's setting (step 4.5 µs, E = 3.5 GPa, 7 spheres, double); softer contacts with a step that is longer as E^{−2/5}. Error: size of the mean of paired differences (same bed), bars: its 95 % interval. Triangles: the interval holds zero; the difference cannot be told from none, and is at most where the triangle is. Black: front of what errors are at most, without settings that the guards would stop (E / 1000 and less). Grey line: the thesis's setting. Numbers at the marks: factor of step or stiffness, number of spheres. Evaluations: of element spheres of one button.
width = 17; height = 15
load style
load tools.'/speed-accuracy/statistical.gpi'
families = 4
array family_key[4] = ['step', 'stiffness', 'spheres', 'precision']
array family_name[4] = ['time step', 'stiffness, with its step', 'spheres per button', 'mixed precision']
array family_tint[4] = [ours, thesis, frictional, '#CC79A7']
array family_mark[4] = [7, 5, 9, 13]
array paint[4] = [0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7]
paint_of(key) = (found = 1, scanned = sum [i=1:4] (family_key[i] eq key ? (found = i, 1) : 0), paint[found])
# what is changed is told by the colour: "step x 2" as ×2, "E / 100" as /100, "3 spheres" as 3
short(s) = s[1:6] eq 'step x' ? '×'.s[8:*] : s[1:6] eq 'step /' ? '/'.s[8:*] : s[1:1] eq 'E' ? '/'.s[5:*] : s[1:5] eq 'mixed' ? '' : word(s, 1)
array quantity[2] = ['rate', 'density']
array ytitle[2] = ['error of the flow rate', 'error of the bulk density']
reference(axis) = system(sprintf("awk -F, '$1 == \"button-hopper\" && $18 == 1 { print $%d; exit }' '%s/points.csv'", axis, data)) + 0
set multiplot
set yrange [5e-3:1]; set ytics 10
do for [i=1:4] {
    column = i % 2 ? 0 : 1; row = i > 2 ? 1 : 0
    set lmargin at screen left_of(i); set rmargin at screen right_of(i); set bmargin at screen bottom_of(i, 0.7); set tmargin at screen top_of(i, 0.7)
    set ylabel (column == 0 ? ytitle[row + 1] : '')
    axis = column == 0 ? 8 : 11
    if (axis == 8) { set format x '%g'; set xtics (0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20) } else { set format x '10^{%T}'; set xtics 10 }
    set xlabel (row == 1 ? (axis == 8 ? cost_title : 'evaluations of spheres of a button per second') : '')
    if (i > 1) { unset label 999; unset key } else { set key at screen 0.53,1 - up(0.1) center top maxrows 1 font small }
    panel = of_panel('button-hopper', '10 cm', quantity[row + 1])
    if (reference(axis) > 0) { set arrow 1 from first reference(axis), graph 0 to first reference(axis), graph 1 nohead lw 1.2 lc rgb '#bbbbbb' back }
    plot front(panel, axis) using 1:2 with steps lw 2 lc rgb ink notitle, \
         for [k=1:families] seen(panel, k) using axis:13:(floor_of($14)):15 with yerrorbars pt family_mark[k] ps 0.8 lw 1.1 lc rgb family_tint[k] title family_name[k], \
         for [k=1:families] unseen(panel, k) using axis:15 with points pt 11 ps 0.9 lc rgb family_tint[k] notitle, \
         rows('points', panel) using axis:15:(short(strcol(5))):(paint_of(strcol(4))) with labels left offset 0.5,0.5 font small tc rgb variable notitle
}
unset multiplot
