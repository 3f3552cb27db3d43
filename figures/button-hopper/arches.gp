# title: Temporary arches
# counterpart: A00 section 4.3.2.4 (in words)
# needs: rates.csv
# caption: Every run of the frictionless fill: number of temporary arches (top) and the longest pause that ended by itself, arch or not (bottom); the line joins the means. Crosses: runs that ended blocked. The source saw temporary arches up to about six particle diameters, and smooth flow above ten.
width = 12; height = 10
load style
mean(column) = sprintf("< awk -F, 'NR > 1 && $1 == \"frictionless\" { n[$2]++; s[$2] += $%d } END { for (d in n) print d \",\" s[d] / n[d] }' '%s/rates.csv' | sort -n", column, data)
spot(x, r) = x + 0.06 * (r - 3 > 8 ? 8 : r - 3)   # replicates side by side
set multiplot
set xrange [4.4:10.6]
set xtics ('' 5, '' 6.5, '' 7.5, '' 8.5, '' 10)
set tmargin at screen 1 - up(0.9); set bmargin at screen 0.60
set key at screen 0.56,1 - up(0.12) center top maxrows 1
set yrange [-0.4:*]; set ytics (0, 1, 2, 3, 4, 5, 6, 8, 10, 15, 20); set ylabel 'arches per run'
set arrow 1 from first 7.2, graph 0 to first 7.2, graph 1 nohead dt (2,3) lw 0.7 lc rgb faint
set label 1 '6 d' at first 7.15, graph 0.95 right tc rgb faint font small
plot rows('rates', '$1 == "frictionless" && $7 == 0') using (spot($2, $3)):13 with points pt 7 ps 0.45 lc rgb ours_light title 'run', \
     rows('rates', '$1 == "frictionless" && $7 == 1') using (spot($2, $3)):13 with points pt 2 ps 0.7 lw 1.2 lc rgb thesis title 'blocked at the end', \
     mean(13) using 1:2 with linespoints lw 1 pt 7 ps 0.8 lc rgb ours title 'mean'
unset label 999; unset key; unset label 1
set tmargin at screen 0.56; set bmargin at screen up(1.75)
set xtics ('5' 5, '6.5' 6.5, '7.5' 7.5, '8.5' 8.5, '10' 10)
set xlabel 'orifice width D (cm)'; set ylabel 'longest pause (s)'; set ytics auto
set yrange [0:*]; set format y '%g'; set xzeroaxis lt 1 lw 0.5 lc rgb hair
plot rows('rates', '$1 == "frictionless" && $7 == 0') using (spot($2, $3)):14 with points pt 7 ps 0.45 lc rgb ours_light, \
     rows('rates', '$1 == "frictionless" && $7 == 1') using (spot($2, $3)):14 with points pt 2 ps 0.7 lw 1.2 lc rgb thesis, \
     mean(14) using 1:2 with linespoints lw 1 pt 7 ps 0.8 lc rgb ours
unset multiplot
