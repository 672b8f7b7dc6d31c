// Colour of a thin film from a lookup texture of Nacreous, for a Custom Function node of Shader Graph in Unity.
// README.md beside this file says how to import the texture and wire the node.

#ifndef NACREOUS_FILM_INCLUDED
#define NACREOUS_FILM_INCLUDED

// ---- the same in every engine: a test holds these lines equal ----

// An axis of the table: its first and last value and how many samples it has, as nacreous:axis.x and .y say.
struct NacreousAxis
{
    float First;
    float Last;
    float Count;
};

// Texture coordinate along an axis of linear mapping: the first and the last texel centre are the ends of the axis. An
// axis of one value has two equal texels.
float NacreousCoordinate(NacreousAxis Axis, float Value)
{
    float Span = Axis.Last - Axis.First;
    float X = Span > 0.0 ? saturate((Value - Axis.First) / Span) : 0.0;
    return (X * (Axis.Count - 1.0) + 0.5) / Axis.Count;
}

// Place in the texture, v counted from the top row, where thickness_scale is smallest.
float2 NacreousPlace(float CosTheta, float ThicknessScale, NacreousAxis CosThetaAxis, NacreousAxis ThicknessScaleAxis)
{
    return float2(NacreousCoordinate(CosThetaAxis, CosTheta), NacreousCoordinate(ThicknessScaleAxis, ThicknessScale));
}

// ---- Unity ----

// Linear colour of R (or of T, from its table) at the cosine of the angle of incidence and a factor on every layer's
// thickness. The axes are (first, last, count). Unity stores pictures bottom row first on every graphics interface, so
// the top row is at v = 1.
float3 NacreousReflectance(
    Texture2D Table, SamplerState TableSampler, float CosTheta, float ThicknessScale,
    float3 CosThetaAxis, float3 ThicknessScaleAxis)
{
    NacreousAxis X = { CosThetaAxis.x, CosThetaAxis.y, CosThetaAxis.z };
    NacreousAxis Y = { ThicknessScaleAxis.x, ThicknessScaleAxis.y, ThicknessScaleAxis.z };
    float2 Place = NacreousPlace(CosTheta, ThicknessScale, X, Y);
    return Table.SampleLevel(TableSampler, float2(Place.x, 1.0 - Place.y), 0.0).rgb;
}

// What Shader Graph calls: a node's function returns nothing and ends in its precision. Half precision would blur
// the place in the table, so there is no _half.
void NacreousReflectance_float(
    Texture2D Table, SamplerState TableSampler, float CosTheta, float ThicknessScale,
    float3 CosThetaAxis, float3 ThicknessScaleAxis, out float3 Reflectance)
{
    Reflectance = NacreousReflectance(Table, TableSampler, CosTheta, ThicknessScale, CosThetaAxis, ThicknessScaleAxis);
}

#endif
