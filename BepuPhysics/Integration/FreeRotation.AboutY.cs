using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics;

// Capsules and cylinders, and what turns the same way about all axes beside them.
static partial class FreeRotation
{
    // Bodies that turn the same way about all axes are among them: to these it makes no difference.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool AreAllAboutY(in Symmetric3x3Wide m)
    {
        var zero = Vector<float>.Zero;
        return Vector.EqualsAll(
            Vector.Equals(m.YX, zero) & Vector.Equals(m.ZX, zero) & Vector.Equals(m.ZY, zero) & Vector.Equals(m.XX, m.ZZ), Vector<int>.AllBitsSet);
    }

    // As Tumble, with the same bits, where the body's Y is an axis of symmetry: u is Y, v is Z, and the middle moment that of X. The body turns about u
    // alone, so that of the two rotations within the body and of all products with them only what is not zero is left, and no axis changes its name.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static unsafe void TumbleAboutY(in Symmetric3x3Wide inverseInertia, PrincipalFrame* frames, Vector<int> indices, Vector<float> dt,
        ref QuaternionWide orientation, ref Vector3Wide angular)
    {
        Vector3Wide own = new(angular.X, angular.Y, angular.Z);
        own = WithoutDust(own, LeastSpeed);
        QuaternionWide frame = new(orientation.X, orientation.Y, orientation.Z, orientation.W);
        var turning = own * dt;
        var slow = new Vector<float>(GreatestSlowAngle * GreatestSlowAngle);
        if (!Vector.LessThanAll(turning.LengthSquared(), slow))
        {
            TumbleAny(inverseInertia, frames, indices, dt, ref orientation, ref angular);
            return;
        }
        var zero = Vector<float>.Zero;
        var one = Vector<float>.One;
        var (across, along) = (inverseInertia.XX, inverseInertia.YY);
        var tumbles = Vector.AndNot(Vector.GreaterThan(across, zero) & Vector.GreaterThan(along, zero), Vector.Equals(across, along)) &
            ~Vector.Equals(own.LengthSquared(), zero);
        if (Vector.EqualsAll(tumbles, Vector<int>.Zero))
        {
            orientation = Tidy(QuaternionWide.Concatenate(frame, FromSmallRotation(turning)));
            return;
        }
        // Lanes that do not tumble compute with unit inertia.
        var inverse = Wide.Select(tumbles, along, one) / Wide.Select(tumbles, across, one);
        var local = QuaternionWide.Conjugate(frame) * own;
        var momentum = local.Y / inverse;
        var rate = (inverse - one) * dt;
        var worldTurn = (frame * new Vector3Wide(local.X, momentum, local.Z)) * dt;
        var square = momentum * momentum + local.Z * local.Z + local.X * local.X;
        if (!Vector.LessThanAll(Wide.Max(worldTurn.LengthSquared(), square * (rate * rate)), slow))
        {
            TumbleAny(inverseInertia, frames, indices, dt, ref orientation, ref angular);
            return;
        }
        Halve<SmallTurn>(rate * new Vector<float>(0.5f) * momentum, out var s, out var c);
        var about = FromSmallRotation(worldTurn);
        // What does not spin about its axis keeps the momentum where it is within the body.
        if (!Vector.EqualsAll(s, zero))
        {
            // Half of the turn, and the other half of what that leaves.
            Vector<float> changeZ = zero, changeX = zero;
            Turn(s, c, local.Z, local.X, ref changeZ, ref changeX);
            Turn(s, c, local.Z + changeZ, local.X + changeX, ref changeZ, ref changeX);
            var sin = c * s + s * c;
            var cos = c * c - s * s;
            // What the velocity changes by when it is turned with the body, added to what it changes by within.
            var turnedZ = -(sin * (local.X + changeX));
            var turnedX = sin * (local.Z + changeZ);
            turnedZ += turnedZ;
            turnedX += turnedX;
            changeZ += turnedZ * cos - sin * turnedX;
            changeX += turnedX * cos + sin * turnedZ;
            own += Rotate(frame, changeX, changeZ);
            frame = new(
                cos * frame.X - sin * frame.Z, cos * frame.Y + sin * frame.W, cos * frame.Z + sin * frame.X, cos * frame.W - sin * frame.Y);
        }
        var turnedAngular = about * own;
        frame = Tidy(QuaternionWide.Concatenate(frame, about));
        if (!Vector.EqualsAll(tumbles, Vector<int>.AllBitsSet))
        {
            QuaternionWide still = new(orientation.X, orientation.Y, orientation.Z, orientation.W);
            frame = QuaternionWide.Select(tumbles, frame, Tidy(QuaternionWide.Concatenate(still, FromSmallRotation(turning))));
            turnedAngular = Vector3Wide.Select(tumbles, turnedAngular, angular);
        }
        angular = turnedAngular;
        orientation = frame;
    }

    // Of a vector without a part along Y.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide Rotate(in QuaternionWide q, Vector<float> x, Vector<float> z)
    {
        var tX = q.Y * z;
        var tY = q.Z * x - q.X * z;
        var tZ = -(q.Y * x);
        tX += tX;
        tY += tY;
        tZ += tZ;
        return new(
            x + tX * q.W + (q.Y * tZ - q.Z * tY),
            tY * q.W + (q.Z * tX - q.X * tZ),
            z + tZ * q.W + (q.X * tY - q.Y * tX));
    }
}
