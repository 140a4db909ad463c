using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>One contact of a bundle of manifolds.</summary>
struct ContactPrestepWide
{
    /// <summary>Position of the contact relative to the centre of A, world axes.</summary>
    public Vector3Wide OffsetA;
    /// <summary>Depth at collision detection; negative where the surfaces are apart.</summary>
    public Vector<float> Depth;
}

/// <summary>How a bundle of contact patches behaves.</summary>
struct ContactMaterialWide
{
    /// <summary>Coulomb coefficient of the patch; with the sign of <see cref="SharesFriction"/>.</summary>
    public Vector<float> FrictionCoefficient;
    /// <summary>Stiffness of the contacts.</summary>
    public SpringSettingsWide SpringSettings;
    /// <summary>Greatest speed at which penetration is corrected.</summary>
    public Vector<float> MaximumRecoveryVelocity;

    /// <summary>
    /// Half the width of the band in which a held patch knows no overlap, over the least distance along the normal of a contact from a centre.
    /// </summary>
    internal const float BandPerExtent = 1e-3f;

    const float LeastBand = 1e-30f;
    /// <summary>Part of the overlap beyond the band that is taken out of held patches for each substep: by a velocity, or out of the poses.</summary>
    internal const float HeldRecovery = 0.04f;
    const int LoneBit = 1;
    const int RestBit = 2;
    const int LiftBit = 4;

    /// <summary>
    /// Patches that are held for the step, by the load path: their frequency is negative, less half the width of the band, m, in which they know no
    /// overlap. What a game gives is not negative, and is written anew for each step. When the step ends the frequency becomes zero again, a negative one.
    /// </summary>
    internal readonly Vector<int> IsHeld => Vector.LessThan(SpringSettings.AngularFrequency, Vector<float>.Zero);

    /// <summary>What the damping ratio of a patch without a frequency of its own says, which has no use for it: whether it was held in the last step.</summary>
    internal static float DampingOfRigid(bool wasHeld, float landing) => wasHeld ? -landing : landing;

    /// <summary>Which of some patches without a frequency of their own were held in the last step.</summary>
    internal static Vector<int> WasHeld(Vector<float> damping) => Vector.LessThan(Vector.AsVectorInt32(damping), Vector<int>.Zero);

    // What the damping ratio of a patch without a frequency of its own says besides, by its amount: that it lands, in one of two substeps; that it
    // finds its load in this one, unless it lands once more, and then in the next; or that it may land in this step. See ConvexContactConstraint.Land.
    const float LandsFirst = 1, LandsAgain = 2, Settles = 3, LandsLast = 4, SettlesLast = 5, MayLand = 6;

    /// <summary>Whether patches land, or may in this step; nothing for those that have a frequency.</summary>
    internal readonly Vector<float> Landing
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Wide.Mask(
            Vector.LessThanOrEqual(SpringSettings.AngularFrequency, Vector<float>.Zero), Wide.Abs(SpringSettings.TwiceDampingRatio));
    }

    /// <summary>The patches that land in this substep.</summary>
    internal readonly Vector<int> Lands => IsRigid & HasLanded(Landing);

    /// <summary>Says which patches may land in this step. Those that do already go on.</summary>
    internal void WatchLanding(Vector<int> isFast)
    {
        var landing = Wide.Abs(SpringSettings.TwiceDampingRatio);
        var isFree = Vector.Equals(landing, Vector<float>.Zero) | Vector.Equals(landing, new Vector<float>(MayLand));
        SetLanding(isFree & (IsRigid | IsHeld), Wide.Mask(isFast & IsRigid, new Vector<float>(MayLand)));
    }

    /// <summary>Goes on to the next substep.</summary>
    /// <returns>Patches whose impulses are those of an impact.</returns>
    internal Vector<int> AdvanceLanding()
    {
        var landing = Landing;
        var landed = HasLanded(landing);
        SetLanding(landed, landing + Vector<float>.One);
        SetLanding(
            Vector.Equals(landing, new Vector<float>(Settles)) | Vector.Equals(landing, new Vector<float>(SettlesLast)), new Vector<float>(MayLand));
        return landed;
    }

    /// <summary>Lets patches land that come fast and may.</summary>
    /// <param name="isFast">What comes fast.</param>
    /// <param name="isVeryFast">What comes as fast as no load brings it in a substep, as the next corner of what has landed on one.</param>
    internal void BeginLanding(Vector<int> isFast, Vector<int> isVeryFast)
    {
        var landing = Wide.Mask(IsRigid, Landing);
        SetLanding(isFast & Vector.Equals(landing, new Vector<float>(MayLand)), new Vector<float>(LandsFirst));
        SetLanding(isVeryFast & Vector.Equals(landing, new Vector<float>(Settles)), new Vector<float>(LandsLast));
    }

    static Vector<int> HasLanded(Vector<float> landing) => Vector.Equals(landing, new Vector<float>(LandsLast)) |
        (Vector.GreaterThan(landing, Vector<float>.Zero) & Vector.LessThanOrEqual(landing, new Vector<float>(LandsAgain)));

    /// <summary>Whether the impulses of a patch are those of an impact.</summary>
    internal static bool HasLanded(float landing) => landing is > 0 and <= LandsAgain or LandsLast;

    readonly Vector<int> IsRigid => Vector.Equals(SpringSettings.AngularFrequency, Vector<float>.Zero);

    // The sign says whether it was held.
    void SetLanding(Vector<int> lanes, Vector<float> landing) => SpringSettings.TwiceDampingRatio = Wide.Select(
        lanes, Wide.CopySign(landing, SpringSettings.TwiceDampingRatio), SpringSettings.TwiceDampingRatio);

    /// <summary>
    /// Of two bodies: patches that are a part of one that several bodies bear which nothing moves. Their coefficient is negative; what a game gives is not.
    /// With one body the place of friction says so.
    /// </summary>
    internal readonly Vector<int> SharesFriction => Vector.LessThan(Vector.AsVectorInt32(FrictionCoefficient), Vector<int>.Zero);

    /// <summary>With one body, held patches whose body has no constraint but them: the last bit of their frequency says so.</summary>
    internal readonly Vector<int> IsHeldAlone => HeldWith(SpringSettings.AngularFrequency, LoneBit);

    /// <summary>Of two bodies, held patches on a floor that turns; the same bit.</summary>
    internal readonly Vector<int> TurnsAlong => HeldWith(SpringSettings.AngularFrequency, LoneBit);

    /// <inheritdoc cref="TurnsAlong"/>
    internal static Vector<int> TurnsAlongOf(Vector<float> frequency) => HeldWith(frequency, LoneBit);

    /// <summary>Held patches whose overlap is taken out of the poses, and not by a velocity: the last bit but two of some frequencies says so.</summary>
    internal static Vector<int> IsLifted(Vector<float> frequency) => HeldWith(frequency, LiftBit);

    /// <summary>Of those that are held alone, patches whose body the warm start of this substep has brought to rest: the last bit but one.</summary>
    internal readonly Vector<int> IsAtRest => HeldWith(SpringSettings.AngularFrequency, RestBit);

    /// <summary>Says which of the patches that are held alone have their body at rest.</summary>
    internal void SetAtRest(Vector<int> lone, Vector<int> rests)
    {
        var bits = Vector.AsVectorInt32(SpringSettings.AngularFrequency);
        var changed = (bits & new Vector<int>(~RestBit)) | (rests & new Vector<int>(RestBit));
        SpringSettings.AngularFrequency = Vector.AsVectorSingle(Wide.Select(lone, changed, bits));
    }

    /// <summary>The frequency of a held patch.</summary>
    /// <param name="band">Half the width of the band in which it knows no overlap, m.</param>
    /// <param name="bit">With one body, whether that has no other constraint; with two, whether it <see cref="TurnsAlong"/>.</param>
    // A band of no width at all would be a spring that is not held.
    internal static Vector<float> HeldSpring(Vector<float> band, Vector<int> bit)
    {
        var bits = Vector.AsVectorInt32(-Wide.Max(band, new(LeastBand)));
        return Vector.AsVectorSingle((bits & new Vector<int>(~(LoneBit | RestBit | LiftBit))) | (bit & new Vector<int>(LoneBit)));
    }

    /// <summary>The frequency of a held patch of a body that has other constraints too.</summary>
    /// <param name="band">Half the width of the band in which it knows no overlap, m.</param>
    /// <param name="turnsAlong">Whether it <see cref="TurnsAlong"/>; of two bodies.</param>
    /// <param name="isLifted">Whether it <see cref="IsLifted"/>.</param>
    internal static float HeldSpring(float band, bool turnsAlong, bool isLifted) => BitConverter.Int32BitsToSingle(
        (BitConverter.SingleToInt32Bits(-MathHelper.Max(band, LeastBand)) & ~(LoneBit | RestBit | LiftBit)) |
        (turnsAlong ? LoneBit : 0) | (isLifted ? LiftBit : 0));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> HeldWith(Vector<float> frequency, int bit)
    {
        var bits = Vector.AsVectorInt32(frequency);
        var wanted = new Vector<int>(int.MinValue | bit);
        return Vector.Equals(bits & wanted, wanted);
    }

    /// <summary>Least depth of a contact that touches, m: zero, or less by the band of a held patch, in which depths mean nothing.</summary>
    internal readonly Vector<float> LeastDepth => Wide.Min(SpringSettings.AngularFrequency, Vector<float>.Zero);
}

/// <summary>A bundle of convex manifolds: contacts that share a normal.</summary>
/// <remarks>The order of the fields is known to <see cref="ContactPrestepLayout"/>, which writes single lanes for any number of contacts.</remarks>
struct ConvexContactPrestepWide<TContacts> where TContacts : unmanaged, IFew<ContactPrestepWide>
{
    /// <summary>The contacts.</summary>
    public TContacts Contacts;
    /// <summary>
    /// Position of B relative to A. With one body: where friction acts, relative to the centre of A, if the patch is a part of one that several statics
    /// bear; zero where it is not. So it is with two bodies that <see cref="ContactMaterialWide.SharesFriction"/>, if B does not turn: what B neither turns
    /// nor is turned by has no arm.
    /// </summary>
    public Vector3Wide OffsetB;
    /// <summary>Unit normal from B to A.</summary>
    public Vector3Wide Normal;
    /// <summary>Friction, stiffness and recovery.</summary>
    public ContactMaterialWide Material;
}

/// <summary>Accumulated impulses of a bundle of convex manifolds, N s.</summary>
struct ConvexContactImpulsesWide<TNormals> where TNormals : unmanaged, IFew<Vector<float>>
{
    /// <summary>Along the normal, per contact.</summary>
    public TNormals Normals;
    /// <summary>Friction of the patch, in world axes and at right angles to the normal.</summary>
    // A vector, not two coordinates: these would belong to tangents that jump somewhere as the normal turns, and with them the load.
    public Vector3Wide Friction;
    /// <summary>Friction against turning about the normal, N m s.</summary>
    public Vector<float> Twist;
}

/// <summary>Where the numbers of a convex contact constraint are, in floats (bundles: in vectors) from its beginning.</summary>
static class ContactPrestepLayout
{
    internal const int FloatsPerContact = 4;
    internal const int Depth = 3;

    internal static int OffsetB(int contactCount) => contactCount * FloatsPerContact;
    internal static int Normal(int contactCount) => OffsetB(contactCount) + 3;
    internal static int Friction(int contactCount) => Normal(contactCount) + 3;
    internal static int Spring(int contactCount) => Friction(contactCount) + 1;
    internal static int Damping(int contactCount) => Spring(contactCount) + 1;
    internal static int MaximumRecovery(int contactCount) => Spring(contactCount) + 2;
    internal static int PrestepFloats(int contactCount) => MaximumRecovery(contactCount) + 1;
    internal static int FrictionImpulse(int contactCount) => contactCount;
    internal static int ImpulseFloats(int contactCount) => contactCount + 4;
}
