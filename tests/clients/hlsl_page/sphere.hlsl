// A mirror of radius 1 at the origin, coated with a film that drains from its top to its bottom, seen in perspective
// from the z axis. Alpha is 1 on it and 0 beside it.

#include "film.hlsli"

cbuffer Scene : register(b0)
{
    float4 CosThetaAxis;
    float4 ThicknessScaleAxis;
    float4 Camera;         // pixels of a side, distance of the eye, half of the picture's width at the origin
    float4 ThicknessScale; // at the top and at the bottom of the sphere
    float4 Light;          // radiance from everywhere, more from above, more from a lamp
};

float Radiance(float3 Towards)
{
    float Lamp = smoothstep(0.88, 0.98, dot(Towards, normalize(float3(-0.5, 0.6, 0.6))));
    return Light.x + Light.y * smoothstep(-0.4, 0.9, Towards.y) + Light.z * Lamp;
}

float4 main(float4 Position : SV_Position) : SV_Target
{
    float2 Place = (2.0 * Position.xy / Camera.x - 1.0) * float2(1.0, -1.0);
    float3 Eye = float3(0.0, 0.0, Camera.y);
    float3 Ray = normalize(float3(Camera.z * Place, -Camera.y));
    // The cross product keeps the digits that a difference of squares would lose near the rim.
    float3 Moment = cross(Eye, Ray);
    float Missed = dot(Moment, Moment);
    if (Missed > 1.0)
        return float4(0.0, 0.0, 0.0, 0.0);
    float3 Normal = Eye + (dot(-Eye, Ray) - sqrt(1.0 - Missed)) * Ray;
    float CosTheta = saturate(dot(Normal, -Ray));
    float Scale = lerp(ThicknessScale.x, ThicknessScale.y, 0.5 - 0.5 * Normal.y);
    float3 Colour = FilmColour(CosTheta, Scale, CosThetaAxis.xyz, ThicknessScaleAxis.xyz);
    return float4(Colour * Radiance(reflect(Ray, Normal)), 1.0);
}
