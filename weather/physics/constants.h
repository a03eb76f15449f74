#ifndef PETRICHOR_WEATHER_PHYSICS_CONSTANTS_H
#define PETRICHOR_WEATHER_PHYSICS_CONSTANTS_H

// Physical constants of the weather room, SI. One place, so that two formulas never disagree.
namespace petrichor::weather {

inline constexpr double kZeroCelsiusK = 273.15;
inline constexpr double kStefanBoltzmann = 5.670374419e-8;  ///< W m-2 K-4
inline constexpr double kAirHeatCapacity = 1005.0;          ///< J kg-1 K-1, dry air
inline constexpr double kAirGasConstant = 287.05;           ///< J kg-1 K-1, dry air
inline constexpr double kVonKarman = 0.4;
inline constexpr double kGravity_m_s2 = 9.81;
inline constexpr double kLatentVaporisation = 2.501e6;  ///< J/kg, liquid to vapour
inline constexpr double kLatentFusion = 0.334e6;        ///< J/kg, ice to liquid
inline constexpr double kLatentSublimation = 2.835e6;   ///< J/kg, ice to vapour
inline constexpr double kIceHeatCapacity = 2100.0;      ///< J kg-1 K-1
inline constexpr double kWaterHeatCapacity = 4180.0;    ///< J kg-1 K-1
inline constexpr double kIceDensity = 917.0;            ///< kg/m3
inline constexpr double kWaterDensity = 1000.0;         ///< kg/m3
inline constexpr double kWaterToAirMass = 0.622;  ///< molar mass of water over that of dry air
inline constexpr double kLapseRate_k_m = 0.0065;  ///< temperature falls with height
inline constexpr double kPi = 3.14159265358979323846;
inline constexpr long long kMicrosPerSecond = 1000000;

}  // namespace petrichor::weather

#endif
