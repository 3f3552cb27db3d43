# title: Discharge
# counterpart: A00 Fig. 5.15
# needs: discharge.csv facts.csv
# caption: Percent of the particles that have left the hopper; middle: its beginning, with the source's delay of 0.08 s; right: steady rate, slope of the linear part (R² of 0.999), with the 95 % interval over replicates; crosses: step and stiffness of the source.
width = 17; height = 6.6
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
set multiplot
set tmargin at screen 1 - up(0.9)
set lmargin at screen across(1.6); set rmargin at screen across(6.4)
set key at screen 0.4,1 - up(0.12) center top maxrows 1
set xlabel 'time (s)'; set ylabel 'discharged (%)'
set xrange [0:*]; set yrange [0:100]
plot for [k=1:4] shape('discharge', k) using 4:5 with lines lw 1.4 lc rgb hue[k] title 'aspect '.k
unset label 999; unset key
set lmargin at screen across(7.6); set rmargin at screen across(11.6)
set ylabel ''
set xrange [0:0.5]; set yrange [0:*]; set xtics 0.1
set arrow 1 from 0.08, graph 0 to 0.08, graph 1 nohead dt (6,3) lw 1 lc rgb thesis
plot for [k=1:4] shape('discharge', k) using ($4 <= 0.5 ? $4 : NaN):5 with lines lw 1.4 lc rgb hue[k]
unset arrow 1
set lmargin at screen across(13.4); set rmargin at screen across(16.7)
set xlabel 'aspect ratio'; set ylabel 'steady rate (%/s)'
set xrange [0.6:4.4]; set xtics 1; set yrange [0:*]
plot fact('rate') using 4:7:(spread($8)) with yerrorbars pt 7 ps 0.7 lw 1.2 lc rgb ours, \
     fact('rate') using 4:7 with lines lw 1.2 lc rgb ours, \
     fact('rate') using 4:9 with points pt 2 ps 0.9 lw 1.4 lc rgb thesis
unset multiplot
