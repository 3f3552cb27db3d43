# title: Normal force on the partitions of a side wall
# counterpart: A00 Fig. 5.19
# needs: walls.csv
# caption: Left wall, tenths of the height of the bed at rest, 1 is the lowest; from the opening on. One run per shape.
width = 17; height = 10.7
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
array tone[10] = ['#440154', '#482878', '#3e4989', '#31688e', '#26828e', '#1f9e89', '#35b779', '#6ece58', '#a5c92f', '#d8c41a']
set multiplot
unset key
set label 20 'partition' at screen 0.22,1 - up(0.4) right tc rgb ink
do for [p=1:10] { set label 20 + p sprintf('{/:Bold %d}', p) at screen 0.22 + 0.055 * p,1 - up(0.4) center tc rgb tone[p] }
set xrange [0:0.8]; set yrange [0:*]
stats data.'/walls.csv' using 4 every ::1 nooutput
top = STATS_max
set yrange [0:100 * ceil(top / 100 + 0.2)]; set ytics 100
do for [k=1:4] {
    left = k % 2 == 1 ? 1.7 : 9.6
    set lmargin at screen across(left); set rmargin at screen across(left + 7)
    set bmargin at screen up(k <= 2 ? 6.3 : 1.8); set tmargin at screen 1 - up(k <= 2 ? 0.95 : 5.45)
    set xlabel (k > 2 ? 'time (s)' : ''); set ylabel (k % 2 == 1 ? 'force (N)' : '')
    set label 1 'aspect '.k at graph 0.97,0.93 right tc rgb ink
    if (k > 1) { unset label 999; do for [p=20:30] { unset label p } }
    plot for [p=1:10] rows('walls', sprintf('$1 == "%d" && $3 == %d', k, p)) using 2:4 with lines lw 1 lc rgb tone[p]
}
unset multiplot
