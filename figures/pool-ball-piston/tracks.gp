# title: Tracks of the particles
# counterpart: A00 Fig. 4.3 (two experiments with the same particles)
# needs: tracks.csv outline.csv
# caption: Middles of the ten particles from the start of the piston to 5 s. Thick: the model at friction 0.1, from the bed as it settled; thin: five replicates laid by hand, with small errors of size, overlap and position. Numbers stand where a track begins; five particles on each side for clarity, as in the source. The measured tracks stand only in its figures.
width = 17; height = 11.2
load style
load tools.'/pool-ball-piston/rig.gpi'
set multiplot
set xlabel 'x (cm)'
do for [i=0:1] {
    set lmargin at screen across(i ? 9.0 : 1.5); set rmargin at screen across(i ? 16.7 : 9.2)
    set ylabel (i ? '' : 'height (cm)')
    if (i) { unset label 999 }
    plot walls using 2:3 with lines lw 1.4 lc rgb ink, \
         for [p=5*i+1:5*i+5] for [r=1:5] path('base', r, p) using 5:6 with lines lw 0.5 lc rgb of(p - 5 * i), \
         for [p=5*i+1:5*i+5] path('base', 0, p) using 5:6 with lines lw 2 lc rgb of(p - 5 * i), \
         for [p=5*i+1:5*i+5] start('base', p) using 5:6 with points pt 7 ps 1.5 lc rgb '#ffffff', \
         for [p=5*i+1:5*i+5] start('base', p) using 5:6:(sprintf('%d', $3)) with labels tc rgb of(p - 5 * i)
}
unset multiplot
