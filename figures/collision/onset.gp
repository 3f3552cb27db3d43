# title: What the onset costs
# counterpart: none, our own measurement
# needs: onset.csv
# caption: Error of the rebound of all schemes against steps per contact, root mean square over the places within a step where the contact can begin. Left: without damping, right: restitution 0.5. Without damping the slope of the force jumps at the touch: schemes of second order and more lose little. With damping the force itself jumps, and all fall to the first order.
width = 17; height = 10
load style
load tools.'/collision/schemes.gpi'
set multiplot
set logscale xy; set xrange [3.5:150]; set xtics ('4' 4, '8' 8, '16' 16, '32' 32, '64' 64, '128' 128)
set yrange [1e-10:3]; set format y '10^{%T}'; set ytics 100
set tmargin at screen 1 - up(1.9)
set xlabel 'steps per contact'
do for [i=1:2] {
    set lmargin at screen (i == 1 ? across(1.7) : 0.5 + across(1.2)); set rmargin at screen (i == 1 ? 0.49 : 1 - across(0.3))
    set ylabel (i == 1 ? 'error of the rebound' : '')
    if (i == 2) { unset label 999; unset key } else { set key at screen 0.53,1 - up(0.1) center top maxrows 4 width -1 font small }
    e = i == 1 ? 1 : 0.5
    plot for [k=1:16] rows('onset', sprintf('$1 == "%s" && $2 == %g', key_of[k], e)) using 3:6 with linespoints lw 1 pt mark[k] ps 0.6 lc rgb tint[k] title name_of[k]
}
unset multiplot
