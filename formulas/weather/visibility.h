// How far one sees, and how much light a metre of air takes (Koschmieder 1924).
#ifndef PETRICHOR_FORMULAS_WEATHER_VISIBILITY_H
#define PETRICHOR_FORMULAS_WEATHER_VISIBILITY_H

// Extinction times visibility, -ln of the contrast that is left: 2 % for Koschmieder's visibility,
// 5 % for the meteorological optical range. Plain literals, so that C++ reads them as doubles.
#define KOSCHMIEDER_2_PERCENT 3.912
#define KOSCHMIEDER_5_PERCENT 2.996

#endif
