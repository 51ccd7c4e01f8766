# SPDX-License-Identifier: Apache-2.0
# The picture of shaders/README.md: one ray through a map of the sample boot, as the tracing text walks it. From the
# root of the repository:
#
#   mkdir -p out && build/release/tests/trace/trace_page walk out
#   gnuplot docs/images/projective-trace.gp
#
#   ray.dat     a block a stretch: sigma x y w W
#   nodes.dat   a block a stretch: visit x0 y0 x1 y1 sigma0 sigma1 w; visit: 0 skipped, 1 opened, 2 cell, 3 hit
#   hit.dat     sigma x y w
# x and y are cells from the middle of the map; the second stretch's sigma goes from 1 to 2.
if (!exists("data")) data = "out"
if (!exists("picture")) picture = "docs/images/projective-trace.png"
set terminal pngcairo size 1800,920 font "DejaVu Sans,19" background "#ffffff"
set output picture
set encoding utf8

ray = "#08306b"
solid = "#d9cdb8"
surface = "#8c6d3f"
skipped = "#4a90c2"
opened = "#555555"
looked = "#e6850e"
hit = "#c8102e"
half = 32 # cells of a quadrant
top = 4.7 # of w

array of[4] = [skipped, opened, looked, hit]

set multiplot
set tics nomirror out
set border 3

# Left: the quadrant.
set lmargin at screen 0.055
set rmargin at screen 0.480
set tmargin at screen 0.935
set bmargin at screen 0.105
set size ratio -1
set xrange [0:half]
set yrange [0:half]
set xtics 0,8
set ytics 0,8
set xlabel "x, cells from the middle of the map" offset 0,0.5
set ylabel "y, cells from the middle of the map" offset 0.9,0
set title "A quadrant of the map: nodes that the walk visits" offset 0,-0.4
do for [i = 1:half-1] {
    set arrow from i,0 to i,half nohead lc rgb "#e6e6e6" lw 1 back
    set arrow from 0,i to half,i nohead lc rgb "#e6e6e6" lw 1 back
}
set arrow from half,0 to 0,half nohead lc rgb "#707070" lw 2 dt 2 back
set label "octant z ≥ 0" at 1,1.4 tc rgb "#505050" front
set label "octant z < 0" at half-1,half-1.2 right tc rgb "#505050" front
set label "fold" at 25.6,7.2 tc rgb "#505050" front
set label "ray" at 1.0,19 tc rgb ray front
set label "hit" at 18.4,20 tc rgb hit front
set key at 0.6,11.4 left top Left reverse samplen 1.5 spacing 1.25
is(n) = int(column(1)) == n
middle_x(n) = is(n) ? (column(2)+column(4))/2 : NaN
name(n) = word("'skipped: begins above the ray' 'opened: its children are next' 'cell, nothing hit' 'cell of the hit'", n+1)
square = "using (middle_x(n)):(($3+$5)/2):(($4-$2)/2):(($5-$3)/2) with boxxyerror"
plot for [n in "1"] data."/nodes.dat" @square lc rgb of[n+1] lw 2 dt 3 fs empty title name(n), \
     for [n in "0 2 3"] "" @square lc rgb of[n+1] lw 1.5 fs solid 0.45 border title name(n), \
     data."/ray.dat" using 2:3 with lines lc rgb ray lw 3 notitle, \
     data."/hit.dat" using 2:3 with points pt 7 ps 1.6 lc rgb hit notitle

# Right: along the ray.
unset arrow
unset label
unset key
set lmargin at screen 0.555
set rmargin at screen 0.985
set size noratio
set xrange [0:2]
set yrange [0:top]
set xtics ("0" 0, "1, 0" 1, "1" 2)
set ytics 0,1
set xlabel "σ along the first stretch, and along the second" offset 0,0.5
set ylabel "w = 1/l; the centre is far above" offset 0.6,0
set title "The same ray, and the surface under it" offset 0,-0.4
set arrow from 1,0 to 1,top nohead lc rgb "#707070" lw 2 dt 2 back
set label "solid: w ≥ W" at 1.25,3.9 front
set label "ray" at 0.05,1.45 tc rgb ray front
set label "W" at 0.83,3.45 tc rgb surface front
set label "hit" at 1.30,2.75 tc rgb hit front
below(x) = x > top ? top : x
drawn(x) = x > top ? NaN : x
from(n) = is(n) ? column(6) : NaN
plot data."/ray.dat" using 1:(below($5)):(top) with filledcurves lc rgb solid fs solid 0.7 noborder, \
     "" using 1:(drawn($5)) with lines lc rgb surface lw 2.5, \
     data."/nodes.dat" using (from(0)):8:($7-$6):(0) with vectors nohead lc rgb of[1] lw 5, \
     "" using (from(1)):8:($7-$6):(0) with vectors nohead lc rgb of[2] lw 2 dt 3, \
     "" using (from(2)):8:($7-$6):(0) with vectors nohead lc rgb of[3] lw 5, \
     "" using (from(3)):8:($7-$6):(0) with vectors nohead lc rgb of[4] lw 5, \
     data."/ray.dat" using 1:4 with lines lc rgb ray lw 3, \
     data."/hit.dat" using 1:4 with points pt 7 ps 1.8 lc rgb hit
unset multiplot
