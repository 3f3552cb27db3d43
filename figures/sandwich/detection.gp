# title: When the guards catch it
# counterpart: none, our own measurement
# needs: limits.csv
# caption: Steps at 1.05 of every limit of the map (1/1.05 of a lower one) from a swing of 1e-13 m until the guard on the overlap stops the run, against what the growth per step of the amplification matrix predicts. One mark per scheme and restitution; line: equal. Marks as in the map.
width = 10; height = 9
load style
load tools.'/sandwich/sandwich.gpi'
set logscale xy; set xrange [10:2e5]; set yrange [10:2e5]; set format '10^{%T}'
set xlabel 'steps predicted'; set ylabel 'steps until the run is stopped'
plot x with lines lw 1 lc rgb faint, \
     for [k=1:16] rows('limits', sprintf('$1 == "%s"', key_of[k])) using 8:($9 > 0 ? $9 : NaN) with points pt mark[k] ps 0.8 lc rgb tint[k]
