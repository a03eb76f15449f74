// Share of the light of a point that the mist on wet ground lets through. It lies on what is level and wet, in wisps; before all else as
// an even layer on the scene's lowest ground, as far as that is wet.
float mist_kept(vec3 position, float up, vec4 weather)
{
    const float level = smooth_edge(0.85, 0.97, up);
    const float wet = max(weather.x * frame.weather.film_albedo, weather.y) * (1.0 - weather.z);
    const float per_m = frame.mist_per_m * mix(frame.weather.film_albedo, wet, level);
    const float depth = mist_depth(per_m, frame.camera_m, position, mix(frame.fog_base_m, position.y, level));
    return exp(-depth * mix(1.0, mist_wisps(position.xz, frame.mist_air_m, frame.time_s), level));
}
