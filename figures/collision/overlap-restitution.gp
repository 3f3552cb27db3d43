# title: Restitution and overlap, linear law
# counterpart: S12 Fig. 2.14
# needs: curves.csv
# caption: Overlap of a linear contact with a dashpot, over the largest without one, against time over the duration of that. The force ends where it would pull (S12 2.23): the curves break off above zero, and what is left of the overlap is passed in free flight. The dashpot is solved so that the measured restitution is the one named. Lines: closed form; marks: Clast.
width = 12; height = 7.5
load style
load tools.'/collision/curves.gpi'
T = most('restitution', 4); D = most('restitution', 5)
set xlabel 'time / duration without damping'; set ylabel 'overlap / largest overlap'
set xrange [0:1.02]; set yrange [0:1.05]; set format y '%.1f'
set tmargin at screen 1 - up(0.9); set key at screen 0.56,1 - up(0.12) center top maxrows 1
plot for [i=1:5] theory('restitution', sprintf('%g', i/5.0)) using ($4/T):($5/D) with lines lw 1.4 lc rgb tone[6-i] title sprintf('e = %g', i/5.0), \
     for [i=1:5] engine('restitution', sprintf('%g', i/5.0)) using ($4/T):($5/D) with points pt 6 ps 0.6 lc rgb tone[6-i]
