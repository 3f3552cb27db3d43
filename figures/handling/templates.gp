# title: The particles
# counterpart: A00 Figs 2.7, 3.29 and Appendix D
# needs: templates.csv
# caption: Element spheres of the three particles of Appendix D(a) to (d) as its input lines RAD and PRO have them, and the five pairs of the bin, all with the volume of a sphere of 1 cm radius; the pairs four times as large. Cross: the centroid that PRO counts from.
width = 17; height = 8.6
load style
unset border; unset tics; unset grid
set size ratio -1
set lmargin at screen 0; set rmargin at screen 1; set bmargin at screen up(0.7); set tmargin at screen 1
set xrange [-17:53]; set yrange [-21.5:11]
set style fill transparent solid 0.12 border lc rgb ours
spheres(s) = rows('templates', sprintf('$1 == "%s"', s))
array aspect[5] = ['1.2', '1.4', '1.6', '1.8', '2.0']
set label 1 'irregular, (b)' at -3,7.6 center tc rgb ink
set label 2 'tapered, (a) and (c)' at 20,7.6 center tc rgb ink
set label 3 'spheroid, (d)' at 42,7.6 center tc rgb ink
# the pairs of the bin are four times as large
set arrow 1 from 15.5,-4.6 to 20.5,-4.6 nohead lw 1.8 lc rgb ink
set label 21 '5 cm' at 21.2,-4.6 left tc rgb ink
set arrow 2 from 45,-18.1 to 49,-18.1 nohead lw 1.8 lc rgb ink
set label 22 '1 cm' at 49.6,-18.1 left tc rgb ink
do for [a=1:5] { set label 3 + a 'aspect '.aspect[a] at -8.5 + (a - 1) * 13.5,-19.8 center tc rgb ink }
plot spheres('irregular') using 2:(0):3 with circles lw 0.8 lc rgb ours, \
     spheres('tapered') using ($2 + 18):(0):3 with circles lw 0.8 lc rgb ours, \
     spheres('spheroid') using ($2 + 42):(0):3 with circles lw 0.8 lc rgb ours, \
     for [a=1:5] spheres(aspect[a]) using (4 * $2 - 8.5 + (a - 1) * 13.5):(-13):(4 * $3) with circles lw 0.8 lc rgb frictional, \
     '-' using 1:2 with points pt 2 ps 0.9 lw 1.5 lc rgb thesis
0,0
18,0
42,0
e
