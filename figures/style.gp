# Style of every figure. A script sets `width` and `height` (cm in print) and loads this file first.
# From make-figures: kind (svg|png), data (folder of the study), out (file), stamp (size, replicates, hash).
set encoding utf8
scale = kind eq 'svg' ? 1.0 : 3.0                  # pixels of the PNG per CSS pixel: 288 dpi
px(cm) = floor(cm / 2.54 * 96 * scale)
face = 'DejaVu Sans'
if (kind eq 'svg') {
    set terminal svg size px(width),px(height) font face.',10.5' enhanced background '#ffffff' linewidth 1
} else {
    set terminal pngcairo size px(width),px(height) font face.',7.9' enhanced fontscale scale \
        linewidth scale pointscale scale dashlength 1.6 background '#ffffff'
}
set output out

set datafile separator ','

number(s) = s eq '' || s eq 'nan' ? NaN : s + 0
spread(x) = x == x ? x : 0   # no interval: no bar

# Colours that stay apart for every kind of colour vision (Okabe and Ito; viridis for the orifices).
ours = '#0072B2'; ours_light = '#8fc1e3'; ours_pale = '#d3e6f5'
experiment = '#1a1a1a'; thesis = '#D55E00'; frictional = '#009E73'
ink = '#333333'; faint = '#8c8c8c'; hair = '#e4e4e4'
array orifice[5] = [5, 6.5, 7.5, 8.5, 10]
array colour[5] = ['#440154', '#3f4a8a', '#26828e', '#2fa866', '#a2b21b']

set border 3 lw 0.7 lc rgb ink
set tics nomirror out scale 0.5 tc rgb ink
set xlabel tc rgb ink; set ylabel tc rgb ink
set grid noxtics ytics back lt 1 lw 0.5 lc rgb hair
set key noautotitle samplen 2 spacing 1.15 height 0.3 tc rgb ink Left reverse
set style fill solid 1.0 noborder
set bars small
set minussign
small = face.(kind eq 'svg' ? ',7.5' : ',5.7')
set label 999 stamp at screen 1 - 0.1 / width, 0.18 / height right font small tc rgb faint noenhanced

# Margins in cm of print: room for tic labels, axis title and the stamp below.
across(cm) = cm / width
up(cm) = cm / height
set lmargin at screen across(1.55); set rmargin at screen 1 - across(0.35)
set bmargin at screen up(1.75); set tmargin at screen 1 - up(0.35)

# Rows of a table of the data folder for which an awk condition holds. The record of NaN at the end keeps gnuplot
# from complaining where a size has no such rows.
none = ' ; echo NaN,NaN,NaN,NaN,NaN,NaN,NaN,NaN,NaN,NaN,NaN,NaN,NaN,NaN'
rows(table, condition) = sprintf("< awk -F, 'NR > 1 && (%s)' '%s/%s.csv'", condition, data, table).none
