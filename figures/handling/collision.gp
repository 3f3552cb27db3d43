# title: The hardest collision with the lower conveyor
# counterpart: A00 Fig. 3.27(b)
# needs: forces.csv
# caption: The same run, every step (line) and every fiftieth (circles) around the largest normal force. What is recorded every 50 steps misses the peak, which is the point of the source's comparison.
width = 12; height = 7.5
load style
around(record) = rows('forces', sprintf('$1 == "lower" && $2 == "%s"', record))
stats around('every') using 3 nooutput
from = STATS_min; to = STATS_max
set lmargin at screen across(1.9)
set xrange [0:1e3 * (to - from)]; set yrange [0:*]
set xlabel 'time (ms)'; set ylabel 'force (N)'
set key top left
plot around('every') using (1e3 * ($3 - from)):4 with lines lw 1.5 lc rgb ours title 'normal, every step', \
     around('every') using (1e3 * ($3 - from)):5 with lines dt (6,4) lw 1.2 lc rgb frictional title 'tangential, every step', \
     around('fiftieth') using ($3 >= from && $3 <= to ? 1e3 * ($3 - from) : NaN):4 with points pt 6 ps 1 lw 1.3 lc rgb thesis title 'normal, every fiftieth'
