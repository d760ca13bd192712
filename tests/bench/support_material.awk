# Sums what G-code extrudes in sections of support and elsewhere: mm^3 and m, with filament of 1.75 mm.
function number(line, letter,    at, text) {
    at = index(line, letter)
    text = substr(line, at + 1)
    sub(/[^0-9.eE+-].*/, "", text)
    return text + 0
}
/^;TYPE:/ { support = /Support/ }
/^M82/ { relative = 0 }
/^M83/ { relative = 1 }
/^G92/ && /E/ { e = number($0, "E") }
/^G[01] / {
    line = $0
    sub(/;.*/, "", line)
    to_x = line ~ /X/ ? number(line, "X") : x
    to_y = line ~ /Y/ ? number(line, "Y") : y
    fed = 0
    if (line ~ /E/) {
        value = number(line, "E")
        fed = relative ? value : value - e
        e = relative ? e + value : value
    }
    way = sqrt((to_x - x) ^ 2 + (to_y - y) ^ 2)
    if (fed > 0 && way > 0) {
        volume[support] += fed
        length_of[support] += way
    }
    x = to_x
    y = to_y
}
END {
    area = 3.14159265358979 / 4 * 1.75 ^ 2
    printf "%.0f mm3, %.1f m\n", volume[1] * area, length_of[1] / 1000
}
