using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

unsafe partial struct FacePolygon
{
    /// <summary>Projects the corners of discs, and segments.</summary>
    /// <param name="points">Centre of a disc, or both ends of a segment, in the shape's frame.</param>
    /// <param name="radius">Radius of a disc.</param>
    /// <param name="frame">Frame to project to.</param>
    // From Z towards X is counter-clockwise seen from +Y; the polygon of the other end is its mirror image. Edges have no lines: inside is what is
    // inside of the rim.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void ProjectDisc(Vector3Wide* points, Vector<float> radius, in FaceFrame frame)
    {
        var vertices = Vertices;
        var first = points[0] - frame.Origin;
        var edge = points[1] - points[0];
        var isSegment = Vector.Equals(Feature.VertexCount, new Vector<int>(2));
        var x = Vector3Wide.Dot(first, frame.X);
        var y = Vector3Wide.Dot(first, frame.Y);
        var height = Vector3Wide.Dot(first, frame.Outwards);
        var highest = Vector<float>.Zero;
        if (Count > 2)
        {
            var radiusX = radius * Feature.PlaneNormal.Y;
            // Of what turns around the axis.
            var (sineX, sineY, sineHeight) = (radiusX * frame.X.X, radiusX * frame.Y.X, radiusX * frame.Outwards.X);
            var (cosineX, cosineY, cosineHeight) = (radius * frame.X.Z, radius * frame.Y.Z, radius * frame.Outwards.Z);
            highest = height + Vector.SquareRoot(sineHeight * sineHeight + cosineHeight * cosineHeight);
            for (int i = 0; i < FaceDisc.CornerCount; ++i)
            {
                ref var vertex = ref vertices[i];
                var sine = new Vector<float>(FaceDisc.Sine(i));
                var cosine = new Vector<float>(FaceDisc.Cosine(i));
                vertex.X = x + (sineX * sine + cosineX * cosine);
                vertex.Y = y + (sineY * sine + cosineY * cosine);
                vertex.Height = height + (sineHeight * sine + cosineHeight * cosine);
                sine = new Vector<float>(FaceDisc.Sine(i + 1) - FaceDisc.Sine(i));
                cosine = new Vector<float>(FaceDisc.Cosine(i + 1) - FaceDisc.Cosine(i));
                vertex.EdgeX = sineX * sine + cosineX * cosine;
                vertex.EdgeY = sineY * sine + cosineY * cosine;
                vertex.EdgeHeight = sineHeight * sine + cosineHeight * cosine;
            }
        }
        Unsafe.SkipInit(out FaceVertex segment);
        segment.X = x;
        segment.Y = y;
        segment.Height = height;
        segment.EdgeX = Vector3Wide.Dot(edge, frame.X);
        segment.EdgeY = Vector3Wide.Dot(edge, frame.Y);
        segment.EdgeHeight = Vector3Wide.Dot(edge, frame.Outwards);
        Select(isSegment, segment, ref vertices[0]);
        Highest = Wide.Select(isSegment, segment.Height + Wide.Max(segment.EdgeHeight, Vector<float>.Zero), highest);
        Extent = Wide.Select(isSegment, Vector.Abs(segment.EdgeX) + Vector.Abs(segment.EdgeY), radius + radius);
        FindSlope(first, frame);
        Disc = new FaceDisc(frame, this, radius);
    }
}
