# title: Tracks at four frictions
# counterpart: A00 Fig. 4.4
# needs: tracks.csv outline.csv friction.csv
# caption: The model at friction 0, 0.1, 0.2 and 0.35, between particles and against the walls, from the same bed and at a tenth of the critical step (the source's figure: at the critical step).
width = 17; height = 7.6
load style
load tools.'/pool-ball-piston/rig.gpi'
array set_of[4] = ['friction 0', 'base', 'friction 0.2', 'friction 0.35']
array name_of[4] = ['0', '0.1', '0.2', '0.35']
set multiplot
set xlabel 'x (cm)'
do for [i=1:4] {
    set lmargin at screen across(1.35 + 3.95 * (i - 1)); set rmargin at screen across(1.35 + 3.95 * i - 0.25)
    set tmargin at screen 1 - up(0.9)
    set ylabel (i == 1 ? 'height (cm)' : '')
    if (i > 1) { set format y ''; unset label 999 }
    set label 1 'friction '.name_of[i] at graph 0.5,1.04 center tc rgb ink
    plot walls using 2:3 with lines lw 1.2 lc rgb ink, \
         for [p=1:10] path(set_of[i], 0, p) using 5:6 with lines lw 1.4 lc rgb of(p)
}
unset multiplot
