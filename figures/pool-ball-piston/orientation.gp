# title: Orientation of the particles
# counterpart: A00 Fig. 4.6 (three of them)
# needs: limits.csv
# caption: Long axis above the horizontal against time. Pale: least and most of five replicates; darker: the 95 % interval of their mean, within which the agreement score asks the model to be; black: the model.
width = 17; height = 10
load style
load tools.'/pool-ball-piston/limits.gpi'
set multiplot
set tics font small
do for [p=1:10] {
    column = (p - 1) % 5; row = (p - 1) / 5
    set lmargin at screen across(1.6 + 3.1 * column); set rmargin at screen across(1.6 + 3.1 * column + 2.1)
    set tmargin at screen 1 - up(0.6 + 4.3 * row); set bmargin at screen 1 - up(0.6 + 4.3 * row + 3.3)
    set xlabel (row == 1 ? 'time (s)' : ''); set ylabel (column == 0 ? 'orientation (°)' : '')
    set label 1 sprintf('particle %d', p) at graph 0.5,1.07 center font small tc rgb ink
    if (p > 1) { unset label 999 }
    plot item('angle', p) using 3:6:7 with filledcurves fc rgb band, \
         item('angle', p) using 3:($4-$5):($4+$5) with filledcurves fc rgb inner, \
         item('angle', p) using 3:8 with lines lw 1.1 lc rgb experiment
}
unset multiplot
