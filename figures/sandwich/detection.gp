# title: When the guards catch it
# counterpart: none, our own measurement
# needs: limits.csv
# caption: Steps at 1.05 of every limit of the map (1/1.05 of a lower one) from a swing of 1e-13 m until the guard on the overlap stops the run, against what the growth per step of the amplification matrix predicts. One mark per scheme and restitution; line: equal. Schemes without a limit are not here.
width = 14; height = 9
load style
load tools.'/sandwich/sandwich.gpi'
array limited[12] = [1, 2, 3, 4, 5, 6, 8, 11, 12, 14, 15, 16]
set logscale xy; set xrange [10:2e5]; set yrange [10:2e5]; set format '10^{%T}'
set xlabel 'steps predicted'; set ylabel 'steps until the run is stopped'
set key at graph 1,0.5 right center reverse Left font small
plot x with lines lw 1 lc rgb faint notitle, \
     for [i=1:12] rows('limits', sprintf('$1 == "%s"', key_of[limited[i]])) using 8:($9 > 0 ? $9 : NaN) \
         with points pt mark[limited[i]] ps 0.8 lc rgb tint[limited[i]] title name_of[limited[i]]
