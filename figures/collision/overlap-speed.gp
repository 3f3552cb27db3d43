# title: Speed of impact and overlap, linear law
# counterpart: S12 Fig. 2.13
# needs: curves.csv
# caption: Overlap of an undamped linear contact at a quarter, half, three quarters and all of the speed, over the largest, against time over the duration. Lines: closed form (S12 2.18); marks: Clast, 1000 steps per contact. The restitution of the source's figure is not printed.
width = 12; height = 7.5
load style
load tools.'/collision/curves.gpi'
T = most('speed', 4); D = most('speed', 5)
set xlabel 'time / duration'; set ylabel 'overlap / largest overlap'
set xrange [0:1.02]; set yrange [0:1.05]; set format y '%.1f'
set tmargin at screen 1 - up(0.9); set key at screen 0.56,1 - up(0.12) center top maxrows 1
plot for [i=1:4] theory('speed', sprintf('%g', i/4.0)) using ($4/T):($5/D) with lines lw 1.4 lc rgb tone[i] title sprintf('%g v', i/4.0), \
     for [i=1:4] engine('speed', sprintf('%g', i/4.0)) using ($4/T):($5/D) with points pt 6 ps 0.6 lc rgb tone[i]
