# title: Ways of nine particles
# counterpart: A00 Fig. 5.11
# needs: tracks.csv
# caption: From their places at rest (dots) through the orifice; left, centre and right column, colour by height. One run per shape.
width = 17; height = 11.8
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
array tone[3] = ['#1a1a1a', '#009E73', '#D55E00']
set multiplot
set size ratio -1
unset grid
set xrange [-side:side]; set yrange [-0.9 * side:4.8 * side]
set xtics (sprintf('%g', -0.5 * side) -0.5 * side, '0' 0, sprintf('%g', 0.5 * side) 0.5 * side); set ytics side
set xlabel 'x (cm)'
slot = 0.7 * side
do for [k=1:4] {
    if (k > 1) { unset label 999 }
    left = 1.8 + 3.8 * (k - 1)
    set lmargin at screen across(left); set rmargin at screen across(left + 3.5)
    set bmargin at screen up(1.8); set tmargin at screen 1 - up(0.7)
    set ylabel (k == 1 ? 'z (cm)' : ''); if (k > 1) { set format y '' }
    set title 'aspect '.k offset 0,-0.5
    set arrow 1 from -side,0 to -slot,0 nohead lw 3 lc rgb experiment
    set arrow 2 from slot,0 to side,0 nohead lw 3 lc rgb experiment
    plot for [c=1:3] for [r=1:3] rows('tracks', sprintf('$1 == "%d" && $2 == %d && $3 == %d', k, c, r)) using 5:6 with lines lw 1.3 lc rgb tone[r], \
         for [r=1:3] rows('tracks', sprintf('$1 == "%d" && $3 == %d && $4 == 0', k, r)) using 5:6 with points pt 7 ps 0.6 lc rgb tone[r]
}
unset multiplot
