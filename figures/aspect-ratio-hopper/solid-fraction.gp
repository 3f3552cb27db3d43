# title: Mean solid fraction and height of the beds
# counterpart: A00 Figs 5.2 and 5.5
# needs: facts.csv
# caption: Left: mean over the cells below the surface, counted as in the source and by the exact area of the discs in each cell. Right: mean height of the surface. Bars: 95 % interval over the replicates; crosses: step and stiffness of the source, one run.
width = 17; height = 6.9
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
set multiplot
set xrange [0.6:4.4]; set xtics 1; set xlabel 'aspect ratio'
set lmargin at screen across(1.7); set rmargin at screen across(8.3)
set ylabel 'solid fraction'
set yrange [*:*]; set format y '%.2f'
set key at screen 0.5,1 - up(0.12) center top maxrows 1 width -4; set tmargin at screen 1 - up(0.9)
plot fact('solid fraction') using 4:7:(spread($8)) with yerrorbars pt 7 ps 0.7 lw 1.2 lc rgb ours title 'as the source counts', \
     fact('solid fraction') using 4:7 with lines lw 1.2 lc rgb ours, \
     fact('solid fraction by area') using ($4 + 0.05):7:(spread($8)) with yerrorbars pt 5 ps 0.6 lw 1.2 lc rgb frictional title 'by area', \
     fact('solid fraction') using 4:9 with points pt 2 ps 0.9 lw 1.4 lc rgb thesis title "source's step and stiffness"
unset label 999
set lmargin at screen across(10.2); set rmargin at screen across(16.7)
set ylabel 'height of the bed (cm)'; set format y '%g'
unset key
plot fact('bed height') using 4:(100 * $7):(100 * spread($8)) with yerrorbars pt 7 ps 0.7 lw 1.2 lc rgb ours, \
     fact('bed height') using 4:(100 * $7) with lines lw 1.2 lc rgb ours, \
     fact('bed height') using 4:(100 * $9) with points pt 2 ps 0.9 lw 1.4 lc rgb thesis
unset multiplot
