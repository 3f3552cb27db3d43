# title: Ahead or behind
# counterpart: none: S12 3.9.1 says in words that explicit is behind
# needs: steps.csv
# caption: Radians per period by which a scheme's swing is ahead of the exact one (left) or behind it (right), without damping. Lines: angle of the eigenvalue of its amplification matrix; marks: fit to the positions of the engine. The Verlet family is ahead by h²/24 of the angle, Numerov ahead by h⁴/480, Taylor, Gear and all other implicit schemes but BDF4 are behind.
width = 17; height = 10
load style
load tools.'/sandwich/sandwich.gpi'
of(k) = rows('steps', sprintf('$1 == "%s"', key_of[k]))
set multiplot
set logscale xy; set xrange [1.6:110]; set xtics (2, 5, 10, 20, 50, 100); set yrange [1e-7:6]; set format y '10^{%T}'; set ytics 10
set xlabel 'steps per contact'
set tmargin at screen 1 - up(1.9)
do for [i=1:2] {
    s = i == 1 ? 1 : -1
    set lmargin at screen (i == 1 ? across(1.7) : 0.5 + across(1.9)); set rmargin at screen (i == 1 ? 0.5 + across(0.1) : 1 - across(0.3))
    set ylabel (i == 1 ? 'ahead, rad per period' : 'behind, rad per period')
    if (i == 2) { unset label 999; unset key } else { set key at screen 0.53,1 - up(0.1) center top maxrows 4 width -1 font small }
    plot for [k=1:16] of(k) using 3:(s*number(strcol(7)) > 0 ? s*$7 : NaN) with lines lw 0.8 lc rgb tint[k] notitle, \
         for [k=1:16] of(k) using 3:(s*number(strcol(8)) > 0 ? s*$8 : NaN) with points pt mark[k] ps 0.6 lc rgb tint[k] notitle, \
         for [k=1:16] NaN with linespoints lw 0.8 pt mark[k] ps 0.6 lc rgb tint[k] title name_of[k]
}
unset multiplot
