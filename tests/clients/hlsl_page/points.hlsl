// The film's colour at places of its table, one pixel each.

#include "film.hlsli"

Texture2D Places : register(t1);
cbuffer Scene : register(b0)
{
    float4 CosThetaAxis;
    float4 ThicknessScaleAxis;
};

float4 main(float4 Position : SV_Position) : SV_Target
{
    float2 Place = Places.Load(int3(int(Position.x), 0, 0)).xy;
    return float4(FilmColour(Place.x, Place.y, CosThetaAxis.xyz, ThicknessScaleAxis.xyz), 1.0);
}
