# SPDX-License-Identifier: Apache-2.0
# gnuplot -e "csv='stability.csv'; png='stability.png'" stability.gp
set terminal pngcairo size 1200,440 font ',11'
set output png
set datafile separator ','
set logscale xy
set format x '10^{%T}'
set format y '10^{%T}'
set yrange [1e-9:10]
set key top left
set grid
set ylabel '|dt| / R'
set multiplot layout 1,3
set title 'Distance of the origin'
set xlabel '|origin| / R'
set xrange [1:1e6]
plot csv using (strcol(1) eq 'origin' ? $2 : NaN):3 with linespoints pt 7 title 'median', \
     csv using (strcol(1) eq 'origin' ? $2 : NaN):4 with linespoints pt 7 title '99 %', \
     csv using (strcol(1) eq 'origin' ? $2 : NaN):5 with linespoints pt 7 title 'largest', \
     4 * 2.0**-23 * x with lines dt 2 lc rgb 'gray40' title '4 ε |origin|'
set title 'Size of the part, origins at 3 R'
set xlabel 'R'
set xrange [1e-6:1e6]
plot csv using (strcol(1) eq 'radius' ? $2 : NaN):3 with linespoints pt 7 title 'median', \
     csv using (strcol(1) eq 'radius' ? $2 : NaN):4 with linespoints pt 7 title '99 %', \
     csv using (strcol(1) eq 'radius' ? $2 : NaN):5 with linespoints pt 7 title 'largest'
set title 'Elongated, turned instances, origins at 3 R'
set xlabel 'longest axis : shortest axis'
set xrange [1:1000]
plot csv using (strcol(1) eq 'turned elongation' ? $2 : NaN):3 with linespoints pt 7 title 'median', \
     csv using (strcol(1) eq 'turned elongation' ? $2 : NaN):4 with linespoints pt 7 title '99 %', \
     csv using (strcol(1) eq 'turned elongation' ? $2 : NaN):5 with linespoints pt 7 title 'largest'
unset multiplot
