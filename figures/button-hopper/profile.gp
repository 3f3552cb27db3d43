# title: Button and model
# counterpart: A00 Figs 4.9 and 4.10
# needs: profile.csv
# caption: Left: the ellipse with the half axes of Table 4.3 and the seven element spheres that stand for it. Right: how far the outline of the spheres stands outside (+) or inside (−) the ellipse, by direction from the centre. The scanned outline of a real button is only in the figure of the source.
width = 17; height = 6.6
load style
profile = data.'/profile.csv'

# r(direction) of the union of the spheres, minus that of the ellipse
deviation = "< awk -F, -f '".tools."/button-hopper/outline.awk' '".profile."'"
set multiplot

set rmargin at screen 0.46
set size ratio -1
set xrange [-0.9:0.9]; set yrange [-0.72:0.72]
set xtics 0.3; set ytics 0.3
set xlabel 'x (cm)'; set ylabel 'z (cm)'
set label 1 'ellipse 0.69 × 0.53 cm' at 0,0.62 center tc rgb experiment
set label 2 '7 spheres' at 0,-0.63 center tc rgb ours
plot rows('profile', '$1 == "sphere"') using 2:3:4 with circles fs transparent solid 0.10 noborder fc rgb ours, \
     rows('profile', '$1 == "sphere"') using 2:3:4 with circles fs empty border lc rgb ours lw 0.9, \
     rows('profile', '$1 == "sphere"') using 2:3 with points pt 7 ps 0.25 lc rgb ours, \
     rows('profile', '$1 == "outline"') using 2:3 with lines lw 1.6 lc rgb experiment

unset label 1; unset label 2; unset label 999
set size noratio
set lmargin at screen 0.59; set rmargin at screen 1 - across(0.5)
set xrange [0:360]; set yrange [*:*]
set xtics 90; set mxtics 3; set ytics auto; set format y '%.2f'
set xlabel 'direction from the major axis (°)'; set ylabel 'spheres − ellipse (mm)'
set xzeroaxis lt 1 lw 0.7 lc rgb ink
plot deviation using 1:2 with lines lw 1.4 lc rgb ours
unset multiplot
