# title: Button hopper: error against cost
# counterpart: none, our own measurement
# needs: points.csv button_runs.csv
# caption: Flow rate (above) and bulk density of the flowing bed (below) at an orifice of 10 cm, one thing changed at a time from the thesis's setting (step 4.5 µs, E = 3.5 GPa, 7 spheres, double); softer contacts with a step that is longer as E^{−2/5}. Error: size of the mean of paired differences (same bed), bars: its 95 % interval. Triangles: the interval holds zero; the difference cannot be told from none, and is at most where the triangle is. Black: front of what errors are at most. Grey line: the thesis's setting. Evaluations: of element spheres of one button.
width = 17; height = 15
load style
load tools.'/speed-accuracy/statistical.gpi'
families = 4
array family_key[4] = ['step', 'stiffness', 'spheres', 'precision']
array family_name[4] = ['time step', 'stiffness, with its step', 'spheres per button', 'mixed precision']
array family_tint[4] = [ours, thesis, frictional, '#CC79A7']
array family_mark[4] = [7, 5, 9, 13]
array quantity[2] = ['rate', 'density']
array ytitle[2] = ['error of the flow rate', 'error of the bulk density']
reference(axis) = system(sprintf("awk -F, '$1 == \"button-hopper\" && $18 == 1 { print $%d; exit }' '%s/points.csv'", axis, data)) + 0
set multiplot
set yrange [5e-4:1]; set ytics 10
do for [i=1:4] {
    column = i % 2 ? 0 : 1; row = i > 2 ? 1 : 0
    set lmargin at screen (column == 0 ? across(1.7) : 0.5 + across(1.0)); set rmargin at screen (column == 0 ? 0.5 - across(0.1) : 1 - across(0.3))
    set bmargin at screen (row == 1 ? up(1.75) : 0.5 * (1 - up(0.2)) + up(0.2)); set tmargin at screen (row == 1 ? 0.5 * (1 - up(0.2)) - up(0.2) : 1 - up(0.9))
    set ylabel (column == 0 ? ytitle[row + 1] : '')
    axis = column == 0 ? 8 : 11
    set xlabel (row == 1 ? (axis == 8 ? cost_title : 'evaluations of spheres of a button per second') : '')
    if (i > 1) { unset label 999; unset key } else { set key at screen 0.53,1 - up(0.1) center top horizontal maxrows 1 font small }
    panel = of_panel('button-hopper', '10 cm', quantity[row + 1])
    if (reference(axis) > 0) { set arrow 1 from first reference(axis), graph 0 to first reference(axis), graph 1 nohead lw 1.2 lc rgb '#bbbbbb' back }
    plot front(panel, axis) using 1:2 with steps lw 2 lc rgb ink notitle, \
         for [k=1:families] seen(panel, k) using axis:13:(floor_of($14)):15 with yerrorbars pt family_mark[k] ps 0.8 lw 1.1 lc rgb family_tint[k] title family_name[k], \
         for [k=1:families] unseen(panel, k) using axis:15 with points pt 11 ps 0.9 lc rgb family_tint[k] notitle, \
         for [k=1:families] seen(panel, k) using axis:15:5 with labels center offset 0,0.6 font small tc rgb family_tint[k] notitle, \
         for [k=1:families] unseen(panel, k) using axis:15:5 with labels center offset 0,0.6 font small tc rgb family_tint[k] notitle
}
unset multiplot
