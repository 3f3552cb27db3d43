# title: Rotational over translational energy
# counterpart: A00 Fig. 5.14
# needs: ratios.csv
# caption: Logarithm (base 10) of the summed rotational over the summed translational energy of the particles in the hopper: in its left, central and right third, and everywhere. At the end particles that have come to rest above a full chamber, or the last few at the sides, turn more than they move. The source shows three of the shapes.
width = 17; height = 7
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
set multiplot
set xrange [0:1.6]; set yrange [-4:0.5]; set xtics 0.5; set ytics 1
do for [c=1:4] {
    left = 1.8 + 3.8 * (c - 1)
    if (c > 1) { unset label 999; unset key } else { set key at screen 0.5,1 - up(0.12) center top maxrows 1 }
    set lmargin at screen across(left); set rmargin at screen across(left + 3.5)
    set tmargin at screen 1 - up(0.9)
    set xlabel 'time (s)'
    set ylabel (c == 1 ? 'log_{10} E_r/E_t' : ''); set format y (c == 1 ? '%g' : '')
    set label 1 word('left centre right hopper', c) at graph 0.05,0.94 left tc rgb ink
    plot for [k=1:4] shape('ratios', k) using 2:(column(2 + c)) with lines lw 1.3 lc rgb hue[k] title 'aspect '.k
}
unset multiplot
