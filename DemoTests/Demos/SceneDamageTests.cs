using System;
using System.Text;
using Demos.Scenes;
using Xunit;

namespace DemoTests.Runner;

/// <summary>A file that is wrong is refused with the line and the token, and costs no more than its length whatever it claims.</summary>
public class SceneDamageTests
{
    /// <summary>Replacements that some place of a file has to refuse, and others that few expect.</summary>
    static readonly string[] poison =
    [
        "nan", "-nan", "inf", "Infinity", "-1", "-0", "1e999", "1e-999", "3.5", "0x10", "1,5", "999999999999", "2147483647", "-2147483648",
        "box", "scene", "bodies", "\u0000", "\u001b[31m", "é", "\ufffd", "", "1 1", "0",
    ];

    [Theory]
    [InlineData(1, 0, "scenes", "scenes")]
    [InlineData(1, 1, "2", "2")]
    [InlineData(1, 1, "1.0", "1.0")]
    [InlineData(2, 0, "nam", "nam")]
    [InlineData(3, 1, "0", "0")]
    [InlineData(3, 1, "ten", "ten")]
    [InlineData(3, 1, "99999999999", "99999999999")]
    [InlineData(4, 1, "-0.5", "-0.5")]
    [InlineData(4, 1, "nan", "nan")]
    [InlineData(5, 1, "1e999", "1e999")]
    [InlineData(6, 1, "2", "2")]
    [InlineData(7, 1, "-1", "-1")]
    [InlineData(8, 0, "cube", "cube")]
    [InlineData(8, 1, "0", "0")]
    [InlineData(8, 3, "-1", "-1")]
    [InlineData(8, 2, "infinity", "infinity")]
    [InlineData(9, 1, "-0.25", "-0.25")]
    [InlineData(10, 2, "-0.5", "-0.5")]
    [InlineData(11, 2, "0", "0")]
    [InlineData(12, 1, "3", "3")]
    [InlineData(13, 1, "2", "2")]
    [InlineData(13, 2, "0", "0")]
    [InlineData(13, 12, "3", "3")]
    [InlineData(13, 14, "-1", "-1")]
    [InlineData(15, 0, "3", "3")]
    [InlineData(15, 0, "-1", "-1")]
    [InlineData(15, 1, "0", "0")]
    [InlineData(16, 1, "-1", "-1")]
    [InlineData(15, 2, "6", "6")]
    [InlineData(15, 2, "-1", "-1")]
    [InlineData(17, 9, "0", "0")]
    [InlineData(17, 10, "0", "0")]
    [InlineData(17, 10, "-2.5", "-2.5")]
    [InlineData(17, 17, "0", "0")]
    [InlineData(17, 18, "NaN", "NaN")]
    [InlineData(17, 24, "-2", "-2")]
    [InlineData(17, 24, "1.5", "1.5")]
    [InlineData(20, 0, "hinge", "hinge")]
    [InlineData(20, 1, "4", "4")]
    [InlineData(20, 2, "-1", "-1")]
    [InlineData(20, 2, "1", "1")]
    [InlineData(20, 2, "0", "0")]
    [InlineData(21, 9, "-0.5", "-0.5")]
    [InlineData(21, 11, "-0.5", "-0.5")]
    [InlineData(21, 11, "0.5 more", "more")]
    public void A_wrong_token_is_named_with_its_line(int line, int token, string replacement, string named)
    {
        var error = Assert.Throws<SceneException>(() => SampleScene.Parse(SampleScene.Replace(line, token, replacement)));

        Assert.Equal(named, error.Token);
        Assert.Equal(line, error.Line);
        Assert.StartsWith($"line {line}: ", error.Message, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(7, "7", 14, "bodies")]
    [InlineData(7, "5", 13, "mesh")]
    [InlineData(14, "5", 19, "joints")]
    [InlineData(14, "3", 18, "2")]
    [InlineData(19, "1", 21, "rag")]
    [InlineData(12, "5", 13, "mesh")]
    public void A_count_that_does_not_match_is_found_where_the_next_thing_begins(int line, string count, int errorLine, string named)
    {
        var error = Assert.Throws<SceneException>(() => SampleScene.Parse(SampleScene.Replace(line, 1, count)));

        Assert.Equal((errorLine, named), (error.Line, error.Token));
        Assert.Contains($"'{named}'", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void A_missing_joint_is_found_at_the_end_of_the_file()
    {
        var error = Assert.Throws<SceneException>(() => SampleScene.Parse(SampleScene.Replace(19, 1, "3")));

        Assert.Equal("", error.Token);
        Assert.Contains("end of the file", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void A_file_cut_before_any_token_is_refused_at_its_end()
    {
        foreach (Range token in SampleScene.Tokens())
        {
            string cut = SampleScene.Text[..token.Start];

            var error = Assert.Throws<SceneException>(() => SampleScene.Parse(cut));

            Assert.Equal("", error.Token);
            Assert.Equal(cut.Split('\n').Length, error.Line);
        }
    }

    [Fact]
    public void A_file_cut_at_any_byte_is_refused_or_read()
    {
        byte[] text = Encoding.UTF8.GetBytes(SampleScene.Text);
        for (int length = 0; length < text.Length; ++length)
            RefuseOrRead(text.AsSpan(0, length));
    }

    [Fact]
    public void A_file_with_any_token_poisoned_is_refused_or_read()
    {
        foreach (Range token in SampleScene.Tokens())
        {
            foreach (string replacement in poison)
                RefuseOrRead(Encoding.UTF8.GetBytes(SampleScene.Text[..token.Start] + replacement + SampleScene.Text[token.End..]));
        }
    }

    [Fact]
    public void A_file_with_any_byte_changed_is_refused_or_read()
    {
        byte[] text = Encoding.UTF8.GetBytes(SampleScene.Text);
        byte[] changes = [0, 0x1B, (byte)' ', (byte)'-', (byte)'9', (byte)'e', 0x80, 0xC3, 0xFF];
        for (int i = 0; i < text.Length; ++i)
        {
            byte before = text[i];
            foreach (byte change in changes)
            {
                text[i] = change;
                RefuseOrRead(text);
            }
            text[i] = before;
        }
    }

    [Theory]
    [InlineData(7, 1)]
    [InlineData(12, 1)]
    [InlineData(13, 1)]
    [InlineData(13, 2)]
    [InlineData(14, 1)]
    [InlineData(15, 1)]
    [InlineData(19, 1)]
    public void A_count_reserves_no_more_than_the_file_can_fill(int line, int token)
    {
        foreach (string count in new[] { "2147483647", "715827882", "1000000000" })
        {
            byte[] text = Encoding.UTF8.GetBytes(SampleScene.Replace(line, token, count));
            long before = GC.GetAllocatedBytesForCurrentThread();

            Assert.Throws<SceneException>(() => SceneFile.Parse(text));

            Assert.InRange(GC.GetAllocatedBytesForCurrentThread() - before, 0, 1 << 20);
        }
    }

    [Fact]
    public void A_message_shows_no_control_characters_and_no_endless_token()
    {
        string hostile = "\u001b[2J" + new string('x', 100_000);

        var error = Assert.Throws<SceneException>(() => SampleScene.Parse(SampleScene.Replace(8, 0, hostile)));

        Assert.DoesNotContain('\u001b', error.Message);
        Assert.InRange(error.Message.Length, 1, 300);
    }

    [Fact]
    public void A_name_with_control_characters_or_broken_encoding_is_refused()
    {
        byte[] broken = Encoding.Latin1.GetBytes(SampleScene.Replace(2, 1, "caf\u00e9"));

        Assert.Throws<SceneException>(() => SampleScene.Parse(SampleScene.Replace(2, 1, "a\u0007b")));
        Assert.Equal(2, Assert.Throws<SceneException>(() => SceneFile.Parse(broken)).Line);
    }

    static void RefuseOrRead(ReadOnlySpan<byte> text)
    {
        try
        {
            SceneFile.Parse(text);
        }
        catch (SceneException error)
        {
            Assert.True(error.Line > 0);
            Assert.NotEmpty(error.Message);
        }
    }
}
