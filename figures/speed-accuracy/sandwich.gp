# title: A ball between two walls: error against cost
# counterpart: S12 Fig. 3.8 has the error of two schemes against the step
# needs: points.csv
# caption: 44 oscillations without loss (S12 3.9.1), steps from 3.5 ms down to 0.02 ms. Above: by what part of a period the ball is out of phase at the end; below: largest change of its energy meanwhile. Left against processor time, right against force evaluations. Black: the front; an error counts only if no finer step of the scheme has a larger one. Newmark-β and the trapezoid rule, one scheme, keep the energy of a linear contact at any step, whatever they do to its phase. Nothing here is left to chance. Below some 10⁻⁹ rounding is what is left.
width = 17; height = 15
load style
load tools.'/speed-accuracy/chart.gpi'
array quantity[2] = ['phase', 'energy']
array ytitle[2] = ['phase at the end, of a period', 'change of the energy']
set multiplot
set yrange [1e-10:3]; set ytics 1e2; set xtics 10
do for [i=1:4] {
    column = i % 2 ? 0 : 1; row = i > 2 ? 1 : 0
    set lmargin at screen left_of(i); set rmargin at screen right_of(i); set bmargin at screen bottom_of(i, 1.8); set tmargin at screen top_of(i, 1.8)
    set ylabel (column == 0 ? ytitle[row + 1] : '')
    axis = column == 0 ? 8 : 11
    set xlabel (row == 1 ? (axis == 8 ? cost_title : evaluations_title) : '')
    if (i > 1) { unset label 999; unset key } else { set key at screen 0.53,1 - up(0.1) center top maxrows 4 width -1 font small }
    panel = of_panel('sandwich', 'e=1', quantity[row + 1])
    set xrange [begin(panel, axis):*]
    plot for [k=1:16] family(panel, key_of[k]) using axis:13 with linespoints lw 0.6 pt mark[k] ps 0.45 lc rgb tint[k] title name_of[k], \
         front(panel, axis) using 1:2 with steps lw 2 lc rgb ink notitle, \
         first_on_front(panel, axis) using 1:2:(nice(strcol(3))) with labels right offset -0.6,-0.5 font small tc rgb ink notitle
}
unset multiplot
