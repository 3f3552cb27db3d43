# title: What each feature of the model is worth, and what leaving it out saves
# counterpart: none, the sources have no such study
# needs: needs.csv
# caption: Size of the mean change of an observable without one feature, paired by seed, with its 95 % interval, against processor time per simulated second over that of the scene as it stands. Hollow marks at the upper end of an interval that holds zero: the change is not told from zero, and is at most this. Left of 1 is cheaper. Features without which some runs give no value (no heap is left) are named in the corner.
width = 17; height = 14.5
load style
load tools.'/scene-needs/needs.gpi'
set multiplot
unset label 999
set logscale y; set yrange [0.1:200]; set format y '%g'
set ytics (0.1, 0.3, 1, 3, 10, 30, 100)
set logscale x; set xrange [0.12:5]; set xtics (0.2, 0.5, 1, 2, 4); set grid xtics ytics
unset key
set datafile separator "\t"
do for [k=1:4] {
    column = (k - 1) % 2; row = (k - 1) / 2
    set lmargin at screen across(1.45 + 6.4 * column); set rmargin at screen across(7.0 + 6.4 * column)
    set tmargin at screen 1 - up(0.75 + 6.8 * row); set bmargin at screen 1 - up(6.1 + 6.8 * row)
    set title sprintf("%s: %s", scene[k], what[k]) offset 0,-0.6 tc rgb ink
    set xlabel 'cost without / with it' tc rgb ink offset 0,0.4
    set arrow 1 from 1, graph 0 to 1, graph 1 nohead lw 0.9 lc rgb faint back
    if (column == 0) { set ylabel 'size of the change, %' tc rgb ink } else { unset ylabel }
    gone = system(sprintf("%s | awk -F '\t' '$11 > 0 { printf \"%%s%%s\", n++ ? \", \" : \"\", $12 }'", command(k)))
    set label 10 (strlen(gone) ? 'no value in some runs without '.gone : '') at graph 0.03,0.05 font small tc rgb faint
    plot for [i=1:11] table(k) using ($1 == i && $7 == 1 ? $2 : NaN):4:5:6 with yerrorbars pt mark[i] ps 0.8 lw 1.1 lc rgb tint[i], \
         for [i=1:11] table(k) using ($1 == i && $7 == 1 ? $2 : NaN):4:3 with xerrorbars pt mark[i] ps 0.8 lw 1.1 lc rgb tint[i], \
         for [i=1:11] table(k) using ($1 == i && $7 == 0 ? $2 : NaN):6 with points pt mark[i] - 1 ps 0.8 lw 1.1 lc rgb tint[i]
}
# the key, in a panel of its own
set lmargin at screen across(13.55); set rmargin at screen 1 - across(0.2)
set tmargin at screen 1 - up(0.75); set bmargin at screen up(1.0)
unset border; unset tics; unset grid; unset title; unset xlabel; unset ylabel; unset logscale; unset label 10; unset arrow 1
set xrange [0:1]; set yrange [0:1]
set key on at graph 0,1 left top Left reverse samplen 1 spacing 1.35
set label 999 stamp at screen 1 - 0.1 / width, 0.18 / height right font small tc rgb faint noenhanced
plot for [i=1:11] NaN with points pt mark[i] ps 0.9 lc rgb tint[i] title name[i]
unset multiplot
