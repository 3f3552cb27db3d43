# title: Beverloo plot
# counterpart: A00 Fig. 4.17
# needs: summary.csv beverloo.csv
# caption: The rate to the power ⅔ against orifice width with least-squares lines, drawn down to where they meet q = 0: that width is kd of eq. 4.5. Ours: all replicates of the frictionless fill, the points show means with 95 % intervals. Lines of experiment and thesis are refitted from Tables 4.4 and 4.5.
width = 12; height = 9
load style
entry(set, column) = number(system(sprintf("awk -F, '$1 == \"%s\" { v = $%d } END { print v }' '%s/beverloo.csv'", set, column, data)))
array name[3] = ['experiment', 'thesis', 'ours']
array said[3] = ['experiment', 'thesis simulation', 'Clast']
array slope[3]; array intercept[3]; array kd[3]; array half[3]
do for [i=1:3] {
    slope[i] = entry(name[i], 2); intercept[i] = entry(name[i], 3)
    kd[i] = entry(name[i], 4); half[i] = entry(name[i], 6)
}
legend(i) = sprintf("%s, kd = %.2f%s cm", said[i], kd[i], half[i] == half[i] ? sprintf(" ± %.2f", half[i]) : "")
least = kd[1]; do for [i=2:3] { if (kd[i] < least) { least = kd[i] } }
set xrange [(least < 0 ? floor(least) : 0):10.6]; set yrange [0:*]; set xtics 2
set xlabel 'orifice width D (cm)'; set ylabel 'q^{2/3}  ((g/s)^{2/3})'
set key top left
p(q) = q ** (2. / 3)
plot [t=0:10.6] \
     (t >= kd[1] ? slope[1] * t + intercept[1] : NaN) with lines lw 0.9 dt (6,4) lc rgb experiment, \
     (t >= kd[2] ? slope[2] * t + intercept[2] : NaN) with lines lw 0.9 dt (2,3) lc rgb thesis, \
     (t >= kd[3] ? slope[3] * t + intercept[3] : NaN) with lines lw 1.2 lc rgb ours, \
     rows('summary', '$1 == "frictionless"') using 2:(p($7)) with points pt 7 ps 0.8 lc rgb experiment title legend(1), \
     rows('summary', '$1 == "frictionless"') using 2:(p($8)) with points pt 9 ps 0.8 lc rgb thesis title legend(2), \
     rows('summary', '$1 == "frictionless"') using 2:(p($5)):(p($5 - spread($6))):(p($5 + spread($6))) with yerrorbars pt 7 ps 0.8 lw 1.2 lc rgb ours title legend(3)
