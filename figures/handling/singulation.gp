# title: Twenty spheroids drawn apart
# counterpart: A00 Fig. 3.32
# needs: tracks.csv passing.csv
# caption: Way of each spheroid along the conveyors, first run. The slow one ends at 96 cm, the fast one carries three times as fast (slopes); at 3 m they wait at the end wall. Circles: where a spheroid is looked at (1.3 m), filled when it touches another one there. One that lies across the belt rolls on it and hardly moves.
width = 17; height = 9
load style
set xrange [0:26]; set yrange [0:300]
set xlabel 'time (s)'; set ylabel 'x (cm)'
set arrow 1 from graph 0,first 96 to graph 1,first 96 nohead lw 1 lc rgb experiment
set arrow 2 from graph 0,first 130 to graph 1,first 130 nohead dt (4,4) lw 0.8 lc rgb faint
set label 1 'slow, 20 cm/s' at graph 0.99,first 85 right tc rgb ink
set label 2 'fast, 60 cm/s' at graph 0.99,first 110 right tc rgb ink
plot for [b=0:19] rows('tracks', sprintf('$1 == "singulation" && $2 == 1 && $3 == %d', b)) using 4:5 with lines lw 1 lc rgb ours, \
     rows('passing', '$1 == 1 && $6 == 1') using 3:(130) with points pt 6 ps 1 lw 1.3 lc rgb thesis, \
     rows('passing', '$1 == 1 && $6 == 0') using 3:(130) with points pt 7 ps 1 lc rgb thesis
