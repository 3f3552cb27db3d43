# title: Tracks at two time steps
# counterpart: A00 Fig. 4.5
# needs: tracks.csv outline.csv
# caption: Left: the critical step of A00 1.28, right: a tenth of it. Thick: the model at friction 0.1; thin: five replicates, laid with the same errors on both sides.
width = 17; height = 11.8
load style
load tools.'/pool-ball-piston/rig.gpi'
array set_of[2] = ['critical', 'base']
array name_of[2] = ['critical step', 'a tenth of it']
set tmargin at screen 1 - up(0.9)
set multiplot
set xlabel 'x (cm)'
do for [i=1:2] {
    set lmargin at screen across(i == 2 ? 9.0 : 1.5); set rmargin at screen across(i == 2 ? 16.7 : 9.2)
    set ylabel (i == 2 ? '' : 'height (cm)')
    if (i == 2) { unset label 999 }
    set label 1 name_of[i] at graph 0.5,1.03 center tc rgb ink
    plot walls using 2:3 with lines lw 1.4 lc rgb ink, \
         for [p=1:10] for [r=1:5] path(set_of[i], r, p) using 5:6 with lines lw 0.4 lc rgb of(p), \
         for [p=1:10] path(set_of[i], 0, p) using 5:6 with lines lw 1.8 lc rgb of(p)
}
unset multiplot
