# title: Restitution against speed
# counterpart: none, S12 section 2.6.4 says it in words
# needs: restitution.csv
# caption: Of all laws, Brilliantov's alone has a restitution that falls with the speed of impact; its constant is solved for 0.7 at 0.5 m/s. Lines: closed form or reference integration; marks: Clast.
width = 12; height = 7.5
load style
set logscale x; set xrange [0.008:6.5]; set yrange [0.4:1]; set format y '%.1f'
set xtics ('0.01' 0.01, '0.1' 0.1, '1' 1)
set xlabel 'speed of impact (m/s)'; set ylabel 'restitution'
set tmargin at screen 1 - up(1.3); set key at screen 0.56,1 - up(0.1) center top maxrows 2
law(name) = rows('restitution', sprintf('$1 == "%s"', name))
plot law('hertz-brilliantov') using 2:3 with lines lw 1.4 lc rgb ours title 'Brilliantov', \
     law('hertz-mindlin') using 2:3 with lines lw 1.4 lc rgb frictional title 'Hertz-Mindlin', \
     law('linear') using 2:4 with points pt 8 ps 0.9 lc rgb thesis title 'linear', \
     law('walton-braun') using 2:4 with points pt 10 ps 0.9 lc rgb experiment title 'Walton-Braun', \
     law('hertz-brilliantov') using 2:4 with points pt 6 ps 0.8 lc rgb ours, \
     law('hertz-mindlin') using 2:4 with points pt 4 ps 0.5 lc rgb frictional
