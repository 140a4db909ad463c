using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

static partial class FlatClosedForm<TShapeWideF, TSupportF, TShapeWideG, TSupportG>
{
    /// <summary>A face and the side of a cylinder.</summary>
    // A line over a face is deepest at the end that is lower, or where it leaves the face on its way there. The direction is the face's normal, or it is
    // tilted out of the edge, as far as the line is at right angles to it.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<int> FindSide(in TShapeWideF f, in SearchFace face, in Vector3Wide offset, in Vector3Wide axis, Vector<float> along,
        Vector<float> radius, Vector<float> halfLength, Vector<int> mask, ref Vector3Wide direction, ref Vector3Wide onF, ref Vector3Wide onG)
    {
        // Downwards, to the face.
        var down = axis * Wide.CopySign(Vector<float>.One, -along);
        var across = face.Place(down);
        var length = across.Length();
        var unit = across * (Vector<float>.One / length);
        var slope = Vector.Abs(along) / length;
        var reach = halfLength * length;
        var tilt = new Vector2Wide(Vector<float>.Zero, Vector<float>.Zero);
        var isEnd = Vector<int>.Zero;
        var gap = Vector<float>.Zero;
        Vector2Wide place = default;
        Vector3Wide line = default;
        for (int i = 0; i < Rounds; ++i)
        {
            var found = face.Tilt(tilt);
            var radial = found - down * Vector3Wide.Dot(found, down);
            line = offset - radial * (radius / radial.Length());
            // Followed to the plane of the face along the direction.
            place = face.Place(line) - tilt * gap;
            var isOver = TSupportF.IsCylinder
                ? CrossDisc(DiscRadius(f), place, unit, out var enter, out var leave, out var outward)
                : CrossPolygon(face, place, unit, out enter, out leave, out outward);
            isEnd = Vector.GreaterThanOrEqual(leave, reach);
            leave = Wide.Min(leave, reach);
            mask &= isOver & Vector.LessThanOrEqual(Wide.Max(enter, -reach), leave);
            var part = Wide.Mask(Vector.OnesComplement(isEnd), slope / Vector2Wide.Dot(outward, unit));
            tilt = outward * part;
            place += unit * leave;
            gap = Vector3Wide.Dot(line, face.Normal) - face.Height - slope * leave;
        }
        mask &= Vector.LessThan(tilt.LengthSquared(), new Vector<float>(GreatestSquaredTilt));
        if (mask == Vector<int>.Zero)
            return mask;
        direction = Vector3Wide.Select(mask, face.Tilt(tilt), direction);
        var end = line + down * halfLength;
        var underEnd = end - face.Normal * (Vector3Wide.Dot(end, face.Normal) - face.Height);
        var point = Vector3Wide.Select(isEnd, underEnd, face.Normal * face.Height + face.Across(place));
        onF = Vector3Wide.Select(mask, point, onF);
        var over = line + down * Wide.Clamp(Vector3Wide.Dot(point - line, down), -halfLength, halfLength);
        onG = Vector3Wide.Select(mask, Vector3Wide.Select(isEnd, end, over), onG);
        return mask;
    }

    /// <summary>Where a line is over a disc about the origin.</summary>
    /// <param name="radius">Radius.</param>
    /// <param name="origin">Origin of the line.</param>
    /// <param name="unit">Its direction.</param>
    /// <param name="enter">Where it comes over the disc.</param>
    /// <param name="leave">Where it leaves it.</param>
    /// <param name="outward">Out of the disc, where it leaves it.</param>
    /// <returns>Lanes in which it does.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> CrossDisc(Vector<float> radius, in Vector2Wide origin, in Vector2Wide unit, out Vector<float> enter, out Vector<float> leave,
        out Vector2Wide outward)
    {
        var along = Vector2Wide.Dot(origin, unit);
        var foot = origin - unit * along;
        var squaredHalf = radius * radius - foot.LengthSquared();
        var half = Vector.SquareRoot(squaredHalf);
        enter = -along - half;
        leave = half - along;
        outward = foot + unit * half;
        return Vector.GreaterThan(squaredHalf, Vector<float>.Zero);
    }

    /// <summary>Where a line is over a polygon; parameters as of <see cref="CrossDisc"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> CrossPolygon(in SearchFace face, in Vector2Wide origin, in Vector2Wide unit, out Vector<float> enter,
        out Vector<float> leave, out Vector2Wide outward)
    {
        var zero = Vector<float>.Zero;
        var isOver = Vector<int>.AllBitsSet;
        enter = new Vector<float>(-float.MaxValue);
        leave = new Vector<float>(float.MaxValue);
        outward = unit;
        var corner = face.Corner(0);
        for (int i = 1; i <= TSupportF.FaceVertexCount; ++i)
        {
            var next = face.Corner(i < TSupportF.FaceVertexCount ? i : 0);
            var edge = next - corner;
            var normal = new Vector2Wide(edge.Y, -edge.X);
            var inside = Vector2Wide.Dot(corner - origin, normal);
            var speed = Vector2Wide.Dot(unit, normal);
            var crossing = inside / speed;
            enter = Wide.Select(Vector.LessThan(speed, zero), Wide.Max(crossing, enter), enter);
            var isNearer = Vector.GreaterThan(speed, zero) & Vector.LessThan(crossing, leave);
            leave = Wide.Select(isNearer, crossing, leave);
            outward = Vector2Wide.Select(isNearer, normal, outward);
            isOver &= Vector.OnesComplement(Vector.Equals(speed, zero)) | Vector.GreaterThanOrEqual(inside, zero);
            corner = next;
        }
        return isOver;
    }
}
