namespace BepuPhysics.CollisionDetection;

/// <summary>Contacts of shapes that may roll.</summary>
static class RollingContacts
{
    /// <summary>Number of contacts from which on they may be carried along with the surfaces while the bodies hardly move.</summary>
    /// <param name="isRound">Whether one of the two shapes is round.</param>
    // What rolls has one contact or two. Carried along they would go up behind it and push it on; a cylinder's end that lies flat has more.
    public static int LeastCarriedCount(bool isRound) => isRound ? 3 : 1;
}
