# title: Walton-Braun beside the linear spring-dashpot
# counterpart: S12 Figs 2.21 and 2.22
# needs: curves.csv
# caption: Restitution 0.5 and the same stiffness while loading. Left: force over the largest of Walton-Braun against overlap; right: overlap against time over the undamped duration. Lines: theory; marks: Clast. The hysteretic contact goes as deep as an undamped one and keeps 1 − e² of it; the dashpot stops the ball earlier.
width = 17; height = 7.5
load style
load tools.'/collision/curves.gpi'
D = most('hysteresis', 5)
F = system(sprintf("awk -F, '$1 == \"hysteresis\" && $2 == \"walton-braun\" && $7 + 0 > m { m = $7 + 0 } END { print m }' '%s/curves.csv'", data)) + 0
T = 2 * system(sprintf("awk -F, '$1 == \"hysteresis\" && $2 == \"walton-braun\" && $3 == \"theory\" && $6 > 0 { t = $4 } END { print t }' '%s/curves.csv'", data))
set multiplot
set tmargin at screen 1 - up(0.9)
set xrange [0:1.05]; set yrange [0:1.1]; set format '%.1f'
set lmargin at screen across(1.6); set rmargin at screen 0.475
set xlabel 'overlap / largest overlap'; set ylabel 'force / largest force'
set key at screen 0.55,1 - up(0.12) center top maxrows 1
plot theory('hysteresis', 'walton-braun') using ($5/D):($7/F) with lines lw 1.4 lc rgb ours title 'Walton-Braun', \
     theory('hysteresis', 'linear') using ($5/D):($7/F) with lines lw 1.4 lc rgb thesis title 'linear spring-dashpot', \
     engine('hysteresis', 'walton-braun') using ($5/D):($7/F) with points pt 6 ps 0.6 lc rgb ours, \
     engine('hysteresis', 'linear') using ($5/D):($7/F) with points pt 8 ps 0.6 lc rgb thesis
unset label 999; unset key
set lmargin at screen 0.5 + across(1.4); set rmargin at screen 1 - across(0.3)
set xlabel 'time / undamped duration'; set ylabel 'overlap / largest overlap'
plot theory('hysteresis', 'walton-braun') using ($4/T):($5/D) with lines lw 1.4 lc rgb ours, \
     theory('hysteresis', 'linear') using ($4/T):($5/D) with lines lw 1.4 lc rgb thesis, \
     engine('hysteresis', 'walton-braun') using ($4/T):($5/D) with points pt 6 ps 0.6 lc rgb ours, \
     engine('hysteresis', 'linear') using ($4/T):($5/D) with points pt 8 ps 0.6 lc rgb thesis
unset multiplot
