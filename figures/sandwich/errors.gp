# title: Error of the position against the step
# counterpart: S12 Fig. 3.8
# needs: steps.csv
# caption: Largest difference from the exact position over 0.45 s, of the amplitude; the source does not print its steps. Above 1 the phase is lost, and an error cannot exceed 2 as long as the ball stays between the walls. Lines end where the ball is thrown out.
width = 17; height = 9
load style
load tools.'/sandwich/sandwich.gpi'
array shown[6] = [4, 16, 6, 8, 13, 10]
set logscale xy; set xrange [0.045:3.6]; set yrange [1e-7:5]; set format y '10^{%T}'; set ytics 10
set xtics (0.05, 0.1, 0.2, 0.5, 1, 2, 3.5)
set xlabel 'time step, ms'; set ylabel 'largest error / amplitude'
set rmargin at screen 1 - across(4.2)
set key at screen 1 - across(4.0),1 - up(0.5) left top
of(k) = rows('steps', sprintf('$1 == "%s" && $6 == 0', key_of[k]))
plot for [i=1:6] of(shown[i]) using (1e3*$2):4 with linespoints lw (i < 3 ? 1.6 : 0.8) pt mark[shown[i]] ps 0.6 lc rgb (i == 1 ? verlet_tint : i == 2 ? numerov_tint : tint[shown[i]]) title name_of[shown[i]]
