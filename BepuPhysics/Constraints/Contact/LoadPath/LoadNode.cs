using System.Numerics;

namespace BepuPhysics.Constraints.Contact;

/// <summary>A body that rests, by whatever is between, on what does not move.</summary>
struct LoadNode
{
    /// <summary>Index in the active set.</summary>
    public int Body;
    /// <summary>Index of the kinematic body along with which it moves; negative where it rests on what does not move.</summary>
    public int Floor;
    /// <summary>What a game has changed of the velocity of that body, where this one is, since the last step, m/s.</summary>
    public Vector3 FloorChange;
    /// <summary>Where it is, less where the arms of the contacts below say that it is, to a floor that turns, m.</summary>
    public Vector3 Lag;
    /// <summary>What it has changed of the angular velocity of that body, rad/s.</summary>
    public Vector3 FloorTurnChange;
    /// <summary>Its supports, one after the other.</summary>
    public int FirstSupport, SupportCount;
    /// <summary>Greatest distance of a contact from the centre, m.</summary>
    public float Radius;
    /// <summary>Velocity that the integration gives it in a substep, m/s.</summary>
    public float Gain;
    /// <summary>Velocity of its contacts after the warm start up to which it is at rest, m/s.</summary>
    public float Tolerance;
    /// <summary>Whether it hands something down in this substep.</summary>
    public bool HasLoad;
    /// <summary>Of the first body of an island: whether the island was worked on in the last substep.</summary>
    public bool IsActive;
    /// <summary>Of the first body of an island: whether the island is to be worked on in this substep.</summary>
    public bool NeedsWork;
    /// <summary>Whether it overlaps what carries it, so far that it is worth waiting until it has been pushed out.</summary>
    public bool IsSunken;
    /// <summary>Whether it overlaps what carries it by more than the band.</summary>
    public bool Overlaps;
    /// <summary>Of the first body of an island: whether any of the island does.</summary>
    public bool HasOverlaps;
    /// <summary>How it is moved and turned out of what carries it in this step, m and rad.</summary>
    public Vector3 Way, Turn;
    /// <summary>Of the first body of an island: whether any of the island is sunken.</summary>
    public bool HasSunken;
    /// <summary>Whether it leans on others: its load goes down by no order.</summary>
    public bool Leans;
    /// <summary>Of the first body of an island: whether any of the island leans, or is of a structure that sways.</summary>
    public bool IsRelaxed;
    /// <summary>Of the first body of an island: whether each of its bodies has one support, so that it may be a column.</summary>
    public bool MayBeColumn;
    /// <summary>Of the first body of an island: whether the island has tipped over in this step.</summary>
    public bool Tips;
    /// <summary>Whether it is of a column that sways.</summary>
    public bool IsOfColumn;
    /// <summary>Whether it is of a structure that sways.</summary>
    public bool IsOfStructure;
    /// <summary>What the transfer has changed of its momentum, N s.</summary>
    public Vector3 Linear;
    /// <summary>What the transfer has changed of its angular momentum, N m s.</summary>
    public Vector3 Angular;

    /// <summary>Forgets what was found in the last step.</summary>
    // One by one: others may read meanwhile which body it is and where its supports are, which a new node would have for a moment as zero.
    internal void Begin()
    {
        FloorChange = Lag = FloorTurnChange = Linear = Angular = Way = Turn = default;
        Radius = Gain = Tolerance = 0;
        HasLoad = IsActive = NeedsWork = IsSunken = HasSunken = Overlaps = HasOverlaps = Tips = false;
    }
}
